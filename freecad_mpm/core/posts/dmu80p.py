"""DIN/ISO programs for a HEIDENHAIN TNC with tool-centre-point control (M128): tip coordinates and rotary angles."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from .program import Floats, Moves, Program, ProgramTool

Flags = NDArray[np.bool_]

FILE_ENDING = ".I"
DIALECT = "din_iso"

DECIMALS = 4  # the finest step of the control: 0.1 µm, 0.0001 degrees
MAX_COORDINATE = 99_999.9999
WIDE_STEP, NARROW_STEP = 10, 1  # between block numbers
# The control's picture takes no blank with sides over this ratio; such a blank is left out, it only serves the picture.
MAX_BLANK_RATIO = 200.0
# What a comment must not hold: the end of a block, the start of a program, another comment.
COMMENT_TAKES = str.maketrans("*%;", "   ")


@dataclass(frozen=True)
class Options:
    end_block: int = 999_999  # TNC 426/430; 99999999 on later controls
    preposition_mm: float = 100.0  # over the first pose, where the rotary axes turn for the first time


def write(program: Program, options: Options = Options()) -> str:
    """The program as text with CRLF line ends, ASCII. All tips must lie over the control's own limits of ±99999 mm.

    Raises InputError for numbers or a length that the control cannot take."""
    moves = program.moves
    _check_range("tip", moves.tip)
    _check_range("angles_deg", moves.angles_deg)
    before, after = _opening(program, options), _closing(program)
    step = _block_step(len(before) + len(moves) + len(after), options.end_block)
    head = f"%{program.name} G71 *"
    return "\r\n".join(
        (
            head,
            *_numbered(before, step, 1),
            _move_blocks(moves, program.machine.rotary_letters, step, len(before) + 1),
            *_numbered(after, step, len(before) + len(moves) + 1),
            f"N{options.end_block} {head}",
            "",
        )
    )


def _opening(program: Program, options: Options) -> list[str]:
    """Blocks without numbers up to the place over the first pose with the tool turned and its tip held."""
    x, y, z = program.moves.tip[0]
    angles = program.moves.angles_deg[0]
    letters = program.machine.rotary_letters
    return [
        *_blank(program),
        f"; {_comment(program)}",
        "M129",
        _retract(program),
        f"T{program.tool.number} G17 S{program.spindle_rpm:.0f}",
        f"G00 {_rotary_words(letters, (0.0, 0.0))} M126",
        f"G00 {_word('X', x)} {_word('Y', y)} M3",
        f"G00 {_word('Z', z + options.preposition_mm)}" + (" M8" if program.coolant else ""),
        "M128",
        f"G00 {_rotary_words(letters, angles)}",
    ]


def _closing(program: Program) -> list[str]:
    return [
        "M129",
        _retract(program),
        f"G00 {_rotary_words(program.machine.rotary_letters, (0.0, 0.0))} M5",
        "M30",
    ]


def _retract(program: Program) -> str:
    return f"G00 G40 G90 {_word('Z', program.machine.setup.retract_z_mm)} M91"


def _blank(program: Program) -> list[str]:
    if program.blank is None:
        return []
    low, high = (_rounded(corner) for corner in program.blank)
    sides = high - low
    if sides.min() <= 0 or sides.max() >= MAX_BLANK_RATIO * sides.min():
        return []
    return [f"G30 G17 {_words('XYZ', low)}", f"G31 G90 {_words('XYZ', high)}"]


def _comment(program: Program) -> str:
    unconfirmed = " - UNCONFIRMED" if program.machine.unconfirmed else ""
    line = f"{program.machine.description}{unconfirmed} - {_tool_text(program.tool)}"
    return line.upper().encode("ascii", "replace").decode().translate(COMMENT_TAKES)


def _tool_text(tool: ProgramTool) -> str:
    radii = f"R{tool.radius_mm:g} R2 {tool.corner_radius_mm:g}"
    if tool.corner_radius_mm == 0:
        return f"T{tool.number} END MILL {radii}"
    return f"T{tool.number} {'BALL' if tool.corner_radius_mm == tool.radius_mm else 'TOROID'} {radii}"


def _move_blocks(moves: Moves, letters: tuple[str, str], step: int, first: int) -> str:
    """All moves at once: one format string and one list of numbers, as formatting them singly would take seconds.

    Columns are N, X, Y, Z, the two angles in the order of their letters, and F; angles and feed are written when they
    change, and X, Y, Z are left out of a rapid that only turns."""
    order = np.argsort(letters)
    angles = _rounded(moves.angles_deg)[:, order]
    feeds = np.where(moves.is_rapid, 0.0, np.round(moves.feed_mm_per_min, 3))
    shown_angles, shown_feed = _changes(angles), _feed_changes(feeds)
    tip = _rounded(moves.tip)
    shown_tip = ~(moves.is_rapid & shown_angles & ~_changes(tip))
    numbers = (np.arange(len(moves)) + first) * step
    values = np.column_stack((numbers, tip, angles, feeds))
    shown = np.ones(values.shape, dtype=bool)
    shown[:, 1:4] = shown_tip[:, None]
    shown[:, 4:6] = shown_angles[:, None]
    shown[:, 6] = shown_feed
    templates = _templates([letters[k] for k in order])
    choice = moves.is_rapid * 8 + shown_tip * 4 + shown_angles * 2 + shown_feed * 1
    lines = "\r\n".join([templates[k] for k in choice.tolist()])
    return lines % tuple(values[shown].tolist())


def _templates(letters: list[str]) -> list[str]:
    """Format of a move block by rapid * 8 + tip shown * 4 + angles shown * 2 + feed shown."""
    choices = product(
        ("G01", "G00"),
        ("", " X%+.9g Y%+.9g Z%+.9g"),
        ("", f" {letters[0]}%+.9g {letters[1]}%+.9g"),
        ("", " F%.8g"),
    )
    return [f"N%.0f {code}{tip}{angles}{feed} *" for code, tip, angles, feed in choices]


def _changes(rows: Floats) -> Flags:
    """(M,): the row differs from the one before; the first is what the opening left."""
    changed = np.zeros(len(rows), dtype=bool)
    changed[1:] = np.any(rows[1:] != rows[:-1], axis=1)
    return changed


def _feed_changes(feeds: Floats) -> Flags:
    """(M,): feed moves (feeds > 0) whose feed is not that of the last feed move."""
    changed = np.zeros(len(feeds), dtype=bool)
    at_feed = np.flatnonzero(feeds > 0)
    changed[at_feed] = np.append(True, np.diff(feeds[at_feed]) != 0)[: len(at_feed)]
    return changed


def _block_step(blocks: int, end_block: int) -> int:
    step = WIDE_STEP if blocks * WIDE_STEP < end_block else NARROW_STEP
    if blocks * step >= end_block:
        raise InputError(
            f"program: {blocks} blocks do not fit below the end block N{end_block}; make it shorter"
        )
    return step


def _numbered(blocks: Iterable[str], step: int, first: int) -> list[str]:
    return [f"N{(first + i) * step} {block} *" for i, block in enumerate(blocks)]


def _rotary_words(letters: tuple[str, str], angles: Floats | tuple[float, float]) -> str:
    return " ".join(_word(letter, angle) for letter, angle in sorted(zip(letters, angles)))


def _words(letters: str, values: Floats) -> str:
    return " ".join(_word(letter, value) for letter, value in zip(letters, values))


def _word(letter: str, value: float) -> str:
    return f"{letter}{_rounded(np.array(value)):+.9g}"


def _rounded(values: Floats) -> Floats:
    return np.round(values, DECIMALS) + 0.0  # no minus zero


def _check_range(name: str, values: Floats) -> None:
    rows = np.flatnonzero(np.any(np.abs(values) > MAX_COORDINATE, axis=1))
    if len(rows):
        raise InputError(f"{name}[{rows[0]}]: must be within {MAX_COORDINATE}, the control takes no more")
