"""What the posts share: rounded words, and the lines of all moves at once."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

import numpy as np

from ..base import Flags, Floats, InputError
from .program import Program, ProgramTool

VECTOR_DECIMALS = 7  # 1e-7 of a unit vector is 0.000006 degrees
FEED_DECIMALS = 3
MAX_COORDINATE = 99_999.9999
MAX_FEED = 99_999.0
# A block that neither travels nor turns still needs a time under inverse-time feed.
SHORTEST_BLOCK_MINUTES = 1e-5


@dataclass(frozen=True)
class Style:
    """How a dialect spells a move: its words in their order, with printf formats for their numbers."""

    rapid: str  # the word of a move at rapid rate, and of one at feed
    feed: str
    length: str  # format of X, Y and Z
    turn_names: tuple[str, ...]  # two rotary axes, or three components of a direction
    turn: str  # format of them
    rate: str = " F%.8g"  # format of the feed with its word
    rapid_end: str = ""  # what a rapid has where others have their feed
    vectors: bool = False  # the tool's direction instead of the rotary axes
    whole: bool = False  # every move has all coordinates
    inverse_time: bool = False  # the feed is 1 / minutes, in every block
    per_block: bool = False  # the feed is that of all five words together, in mm and degrees


@dataclass(frozen=True)
class MoveTable:
    """All moves with their numbers rounded as they are written, and which of them are."""

    rapid: Flags  # (M,) at rapid rate
    xyz: Floats  # (M, 3)
    turn: Floats  # (M, 2) readings in the order of the letters, or (M, 3) directions
    feed: Floats  # (M,) number of the F word
    show_xyz: Flags  # (M,)
    show_turn: Flags
    show_feed: Flags


def move_table(program: Program, style: Style) -> MoveTable:
    """Raises InputError for a number that the controls cannot take."""
    moves, decimals = program.moves, program.options.decimals
    check_range("tip", program.xyz_mm)
    check_range("rotary_deg", moves.rotary_deg)
    xyz = rounded(program.xyz_mm, decimals)
    angles = rounded(moves.rotary_deg, decimals)[:, rotary_order(program)]
    travels, turns = changes(xyz), changes(angles)
    # The joints' way is only straight at feed, and only then are the tip and the tool's direction where they should be.
    rapid = moves.is_rapid if program.tcp else moves.is_rapid & ~(travels & turns)
    feed = _feed_words(program, style, np.hstack((xyz, angles)))
    own_feed = style.inverse_time or style.per_block
    return MoveTable(
        rapid=rapid,
        xyz=xyz,
        turn=rounded(moves.axis, VECTOR_DECIMALS) if style.vectors else angles,
        feed=feed,
        show_xyz=~(rapid & turns & ~travels) | style.whole,
        show_turn=turns | style.whole,
        show_feed=~rapid if own_feed else new_feeds(np.where(rapid, 0.0, feed)),
    )


def move_lines(program: Program, style: Style) -> list[str]:
    """One line a move, and what follows it. One format string and one list of numbers: formatting them singly would take
    seconds."""
    table = move_table(program, style)
    shown = np.column_stack(
        (
            np.repeat(table.show_xyz[:, None], 3, axis=1),
            np.repeat(table.show_turn[:, None], table.turn.shape[1], axis=1),
            table.show_feed,
        )
    )
    values = np.column_stack((table.xyz, table.turn, table.feed))
    templates = _templates(style)
    choice = table.rapid * 8 + table.show_xyz * 4 + table.show_turn * 2 + table.show_feed * 1
    text = "\n".join([templates[k] for k in choice.tolist()])
    return (text % tuple(values[shown].tolist())).split("\n")


def with_stops(program: Program, lines: list[str], stop: str, comment: str) -> list[str]:
    """The lines of all moves with those that make the machine wait; `comment`: a format of its text."""
    if not program.stops:
        return lines
    result = []
    for move, line in enumerate(lines):
        result.append(line)
        if move in program.stops:
            result += [comment.format(program.stops[move]), stop]
    return result


def _templates(style: Style) -> list[str]:
    """Format of a move by rapid * 8 + xyz shown * 4 + turn shown * 2 + feed shown."""
    xyz = "".join(f" {letter}{style.length}" for letter in "XYZ")
    turn = "".join(f" {name}{style.turn}" for name in style.turn_names)
    choices = product(
        ((style.feed, ""), (style.rapid, style.rapid_end)), ("", xyz), ("", turn), ("", style.rate)
    )
    return [f"{code}{tip}{angles}{feed or end}" for (code, end), tip, angles, feed in choices]


def _feed_words(program: Program, style: Style, words: Floats) -> Floats:
    moves = program.moves
    if style.inverse_time:
        return 1.0 / block_minutes(program)
    if not style.per_block:
        return np.where(moves.is_rapid, 0.0, np.round(moves.feed_mm_per_min, FEED_DECIMALS))
    way = np.linalg.norm(np.diff(words, axis=0, prepend=words[:1]), axis=1)
    return np.clip(np.round(way / block_minutes(program), FEED_DECIMALS), 1.0, MAX_FEED)


def block_minutes(program: Program) -> Floats:
    """(M,) time of each move: of the tip at its feed (rapids: none), or of an axis at its greatest velocity."""
    moves, machine = program.moves, program.machine
    way = np.linalg.norm(_steps(moves.tip), axis=1)
    minutes = way / np.where(moves.is_rapid, np.inf, moves.feed_mm_per_min)
    for k, rotary in enumerate(machine.rotary_axes):
        minutes = np.maximum(
            minutes, np.abs(_steps(moves.rotary_deg))[:, k] / rotary.max_velocity_deg_per_min
        )
    if program.axes_mm is not None:
        for k, linear in enumerate(machine.linear_axes):
            minutes = np.maximum(
                minutes, np.abs(_steps(program.axes_mm))[:, k] / linear.max_velocity_mm_per_min
            )
    return np.maximum(minutes, SHORTEST_BLOCK_MINUTES)


def _steps(rows: Floats) -> Floats:
    return np.diff(rows, axis=0, prepend=rows[:1])


def changes(rows: Floats) -> Flags:
    """(M,): the row differs from the one before; the first is what the opening left."""
    changed = np.zeros(len(rows), dtype=bool)
    changed[1:] = np.any(rows[1:] != rows[:-1], axis=1)
    return changed


def new_feeds(feeds: Floats) -> Flags:
    """(M,): feed moves (feeds > 0) whose feed is not that of the last feed move."""
    changed = np.zeros(len(feeds), dtype=bool)
    at_feed = np.flatnonzero(feeds > 0)
    changed[at_feed] = np.append(True, np.diff(feeds[at_feed]) != 0)[: len(at_feed)]
    return changed


def rotary_order(program: Program) -> list[int]:
    """The rotary axes in the order of their letters."""
    return np.argsort(program.machine.rotary_letters).tolist()


def rotary_names(program: Program) -> tuple[str, ...]:
    """The letters in their order, which need not be the chain's."""
    return tuple(sorted(program.machine.rotary_letters))


def first_rotary(program: Program) -> list[float]:
    """Where the rotary axes stand for the first move, in the order of their letters."""
    return program.moves.rotary_deg[0, rotary_order(program)].tolist()


def rounded(values: Floats, decimals: int) -> Floats:
    """To decimals, half to even; never -0.0, which would be written with its sign."""
    return np.round(values, decimals) + 0.0  # no minus zero


def words(names: Iterable[str], values: Iterable[float], form: str, decimals: int) -> str:
    """Words side by side, rounded, in a printf format."""
    return " ".join(name + form % rounded(np.array(value), decimals) for name, value in zip(names, values))


def tool_text(tool: ProgramTool) -> str:
    """The cutter as a comment tells it: number, kind, radius over all and corner radius."""
    radii = f"R{tool.radius_mm:g} R2 {tool.corner_radius_mm:g}"
    if tool.corner_radius_mm == 0:
        return f"T{tool.number} END MILL {radii}"
    return f"T{tool.number} {'BALL' if tool.corner_radius_mm == tool.radius_mm else 'TOROID'} {radii}"


def description(program: Program) -> str:
    """Machine and tool for a comment."""
    unconfirmed = " - UNCONFIRMED" if program.machine.unconfirmed else ""
    joints = "" if program.tcp else " - JOINT POSITIONS, NO TCP"
    return plain(f"{program.machine.description}{unconfirmed}{joints} - {tool_text(program.tool)}")


def plain(text: str) -> str:
    """Capital letters, digits, blanks, dots, commas and dashes, which no control minds in a comment."""
    return "".join(c if c.isascii() and (c.isalnum() or c in " .,-") else " " for c in text.upper())


def check_range(name: str, values: Floats) -> None:
    """Raises InputError that names the first row (of rows of mm or degrees) that no word can hold."""
    rows = np.flatnonzero(np.any(np.abs(values) > MAX_COORDINATE, axis=1))
    if len(rows):
        raise InputError(f"{name}[{rows[0]}]: must be within {MAX_COORDINATE}, the control takes no more")
