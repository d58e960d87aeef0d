"""DIN/ISO programs for a HEIDENHAIN TNC: tip coordinates and rotary angles under M128, or joint positions."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

from ..base import Floats, InputError
from . import tnc
from .program import Program
from .writing import description, first_rotary, move_lines, rotary_names, with_stops, words

FILE_ENDING = ".I"
DIALECT = "din_iso"
JOINTS = True
OPTIONS = tnc.OPTIONS | {"end_block", "tool_change"}

WIDE_STEP, NARROW_STEP = 10, 1  # between block numbers


def write(first: Program, *more: Program) -> str:
    """The program as text with CRLF line ends, ASCII; more: what follows with other tools. All coordinates must lie
    over the control's own limits of ±99999 mm.

    Raises InputError for numbers or a length that the control cannot take."""
    sections = chain.from_iterable(_section(program) for program in (first, *more))
    blocks = [*_blank(first), *sections, "M30"]
    head, end = f"%{first.name} G71 *", first.options.end_block
    step = _block_step(len(blocks), end)
    numbered = [f"N{step * i} {block} *" for i, block in enumerate(blocks, 1)]
    return "\r\n".join((head, *numbered, f"N{end} {head}", ""))


def _section(program: Program) -> list[str]:
    """All blocks with one tool."""
    moves = move_lines(program, tnc.style(program, "G00", "G01"))
    return [*_opening(program), *with_stops(program, moves, "M0", "; {}"), *_closing(program)]


def _opening(program: Program) -> list[str]:
    """Up to the place over the first pose with the tool turned; under M128 it turns there with its tip held."""
    options, rotary = program.options, rotary_names(program)
    x, y, z = program.xyz_mm[0].tolist()
    start: Sequence[float] = (0.0, 0.0) if program.tcp else first_rotary(program)
    above = z + options.preposition_mm if program.tcp else z
    blocks = [
        *([f"; {description(program)}"] if options.comments else []),
        "M129",
        _retract(program),
        f"T{program.tool.number} G17 S{program.spindle_rpm:.0f}" + (" M6" if options.tool_change else ""),
        *_tolerance(program),
        f"G00 {_words(program, rotary, start)} M126",
        f"G00 {_words(program, 'XY', (x, y))} {program.spindle_word}",
        " ".join(filter(None, (f"G00 {_words(program, 'Z', (above,))}", options.coolant_word))),
    ]
    return blocks + (["M128", f"G00 {_words(program, rotary, first_rotary(program))}"] if program.tcp else [])


def _closing(program: Program) -> list[str]:
    return [
        *(["M140 MB MAX"] if program.options.retract == "tool_axis" else []),
        "M129",
        _retract(program),
        f"G00 {_words(program, rotary_names(program), (0.0, 0.0))} M5",
    ]


def _retract(program: Program) -> str:
    return f"G00 G40 G90 {_words(program, 'Z', (program.machine.setup.retract_z_mm,))} M91"


def _tolerance(program: Program) -> list[str]:
    """Cycle 32."""
    options = program.options
    if not options.path_tolerance_mm:
        return []
    mode = 0 if options.smoothing == "finish" else 1
    return [f"G62 T{options.path_tolerance_mm:g} P01 {mode} P02 {options.rotary_tolerance_deg:g}"]


def _blank(program: Program) -> list[str]:
    corners = tnc.blank(program)
    if corners is None:
        return []
    return [
        f"{code} {_words(program, 'XYZ', corner)}" for code, corner in zip(("G30 G17", "G31 G90"), corners)
    ]


def _block_step(blocks: int, end_block: int) -> int:
    step = WIDE_STEP if blocks * WIDE_STEP < end_block else NARROW_STEP
    if blocks * step >= end_block:
        raise InputError(
            f"program: {blocks} blocks do not fit below the end block N{end_block}; make it shorter"
        )
    return step


def _words(program: Program, names: Sequence[str], values: Floats | Sequence[float]) -> str:
    return words(names, values, tnc.LENGTH, program.options.decimals)
