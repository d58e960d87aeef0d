"""Siemens 840D: TRAORI with rotary angles (ORIAXES) or the tool's direction as a vector (ORIVECT), or joint
positions."""

from __future__ import annotations

from itertools import chain

from . import iso6983
from .iso6983 import axis_words, rotary_zero
from .program import Program
from .writing import description, first_rotary, rotary_names

FILE_ENDING = ".MPF"
DIALECT = "sinumerik"
JOINTS = True
OPTIONS = iso6983.OPTIONS | {"path_tolerance_mm", "rotary_tolerance_deg", "smoothing"}
VECTOR = ("A3=", "B3=", "C3=")


def write(first: Program, *more: Program, vectors: bool = False) -> str:
    """The datum is G54; a rotary axis that goes over 360 degrees must not be a modulo axis of the control. more: what
    follows with other tools."""
    comment = description(first) if first.options.comments else ""
    sections = chain.from_iterable(_section(program, vectors) for program in (first, *more))
    numbered = [f"N{10 * i} {block}" for i, block in enumerate(chain(sections, ["M30"]), 1)]
    return "\n".join([f"; {first.name} - {comment}", *numbered, ""])


def _section(program: Program, vectors: bool) -> list[str]:
    """All blocks with one tool."""
    moves = iso6983.moves(program, "; {}", VECTOR if vectors else None)
    opening = _opening_tcp(program, vectors) if program.tcp else _opening_joints(program)
    return [*_start(program), *opening, *moves, *_closing(program)]


def _start(program: Program) -> list[str]:
    start = rotary_zero(program)
    if not program.tcp:
        start = axis_words(program, rotary_names(program), first_rotary(program))
    return [
        "G17 G40 G71 G90 G94",
        "TRAFOOF",
        _retract(program),
        f"T{program.tool.number} M6",
        " ".join(
            filter(None, (f"S{program.spindle_rpm:.0f} {program.spindle_word}", program.options.coolant_word))
        ),
        *_tolerance(program),
        f"G54 D1 G0 {start}",
    ]


def _opening_tcp(program: Program, vectors: bool) -> list[str]:
    x, y, z = program.xyz_mm[0].tolist()
    angles = axis_words(program, rotary_names(program), first_rotary(program))
    return [
        "TRAORI",
        "G54",
        "ORIWKS ORIVECT" if vectors else "ORIMKS ORIAXES",
        f"G0 {axis_words(program, 'XY', (x, y))}",
        f"G0 {axis_words(program, 'Z', (z + program.options.preposition_mm,))}",
        f"G0 {iso6983.vector_words(program, VECTOR) if vectors else angles}",
    ]


def _opening_joints(program: Program) -> list[str]:
    x, y, z = program.xyz_mm[0].tolist()
    return [
        f"G0 {axis_words(program, 'XY', (x, y))}",
        f"G0 {axis_words(program, 'Z', (z,))}",
        iso6983.INVERSE_TIME,
    ]


def _closing(program: Program) -> list[str]:
    off = "TRAFOOF" if program.tcp else iso6983.PER_MINUTE
    return [off, _retract(program), f"G0 {rotary_zero(program)}", "M9", "M5"]


def _retract(program: Program) -> str:
    return f"SUPA G0 {axis_words(program, 'Z', (program.machine.setup.retract_z_mm,))} D0"


def _tolerance(program: Program) -> list[str]:
    options = program.options
    if not options.path_tolerance_mm:
        return []
    mode = "_ORI_FINISH" if options.smoothing == "finish" else "_ORI_ROUGH"
    return [f"CYCLE832({options.path_tolerance_mm:g},{mode},{options.rotary_tolerance_deg:g})"]
