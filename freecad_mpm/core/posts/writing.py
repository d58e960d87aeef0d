"""What the posts share: rounded words, and the moves one by one with what changes in them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ..errors import InputError
from .program import Floats, Program, ProgramTool

LINEAR_DECIMALS = ANGLE_DECIMALS = 4  # 0.1 µm, 0.0001 degrees: the finest step of the controls in the field
VECTOR_DECIMALS = 7  # 1e-7 of a unit vector is 0.000006 degrees
MAX_COORDINATE = 99_999.9999
PREPOSITION_MM = 100.0  # over the first pose, where the rotary axes turn for the first time
SECONDS_PER_MINUTE = 60.0
# A block that neither travels nor turns still needs a time under inverse-time feed.
SHORTEST_BLOCK_MINUTES = 1e-5


@dataclass(frozen=True)
class Step:
    """One move, its numbers rounded as they are written."""

    rapid: bool
    travels: bool  # the tip goes somewhere; the first move counts as travelling
    turns: bool  # a rotary axis does
    tip: list[float]  # X, Y, Z
    axis: list[float]  # unit vector from the tip to the spindle
    rotary: list[tuple[str, float]]  # letter and reading, in the order of the letters
    feed: float  # mm/min of the tip
    new_feed: bool  # not that of the last feed move
    minutes: float  # what the move takes at its feed, with no rotary axis over its greatest velocity


def steps(program: Program) -> Iterator[Step]:
    """All moves. Raises InputError for a number that the controls cannot take."""
    moves, machine = program.moves, program.machine
    _check_range("tip", moves.tip)
    _check_range("angles_deg", moves.angles_deg)
    tip, angles = rounded(moves.tip, LINEAR_DECIMALS), rounded(moves.angles_deg, ANGLE_DECIMALS)
    axis = rounded(moves.axis, VECTOR_DECIMALS)
    letters, order = machine.rotary_letters, np.argsort(machine.rotary_letters)
    minutes = block_minutes(program)
    last_feed = 0.0
    for i, rapid in enumerate(moves.is_rapid.tolist()):
        feed = 0.0 if rapid else float(np.round(moves.feed_mm_per_min[i], 3))
        yield Step(
            rapid=rapid,
            travels=i == 0 or bool(np.any(tip[i] != tip[i - 1])),
            turns=i > 0 and bool(np.any(angles[i] != angles[i - 1])),
            tip=tip[i].tolist(),
            axis=axis[i].tolist(),
            rotary=[(letters[k], float(angles[i, k])) for k in order],
            feed=feed,
            new_feed=not rapid and feed != last_feed,
            minutes=float(minutes[i]),
        )
        last_feed = last_feed if rapid else feed


def block_minutes(program: Program) -> Floats:
    """(M,) time of each feed move: of the tip at its feed, or of a rotary axis at its greatest velocity."""
    moves = program.moves
    way = np.linalg.norm(np.diff(moves.tip, axis=0, prepend=moves.tip[:1]), axis=1)
    minutes = way / np.where(moves.is_rapid, np.inf, moves.feed_mm_per_min)
    turn = np.abs(np.diff(moves.angles_deg, axis=0, prepend=moves.angles_deg[:1]))
    for k, axis in enumerate(program.machine.rotary_axes):
        minutes = np.maximum(minutes, turn[:, k] / axis.max_velocity_deg_per_min)
    return np.maximum(minutes, SHORTEST_BLOCK_MINUTES)


def rounded(values: Floats, decimals: int) -> Floats:
    return np.round(values, decimals) + 0.0  # no minus zero


def number(value: float, decimals: int = LINEAR_DECIMALS) -> str:
    """Without exponent and trailing zeros, with a decimal point always: some controls read 5 as 0.005."""
    text = f"{value:.{decimals}f}".rstrip("0")
    return "0." if text == "-0." else text


def signed(value: float, decimals: int = LINEAR_DECIMALS) -> str:
    """With its sign and no more than it needs, as a TNC shows it."""
    text = f"{value:+.{decimals}f}".rstrip("0").rstrip(".")
    return "+0" if text in ("-0", "+0") else text


def rotary_zero(program: Program) -> list[tuple[str, float]]:
    return [(letter, 0.0) for letter in sorted(program.machine.rotary_letters)]


def description(program: Program) -> str:
    """Machine and tool for a comment: capital letters, digits, blanks, dots and dashes, which no control minds."""
    unconfirmed = " - UNCONFIRMED" if program.machine.unconfirmed else ""
    line = f"{program.machine.description}{unconfirmed} - {_tool(program.tool)}".upper()
    return "".join(c if c.isascii() and (c.isalnum() or c in " .-") else " " for c in line)


def _tool(tool: ProgramTool) -> str:
    return f"T{tool.number} R{tool.radius_mm:g} CORNER R{tool.corner_radius_mm:g}"


def _check_range(name: str, values: Floats) -> None:
    rows = np.flatnonzero(np.any(np.abs(values) > MAX_COORDINATE, axis=1))
    if len(rows):
        raise InputError(f"{name}[{rows[0]}]: must be within {MAX_COORDINATE}, controls take no more")
