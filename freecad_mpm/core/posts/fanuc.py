"""Fanuc 30i class: tool-centre-point control with rotary angles (G43.4) or the tool's direction (G43.5), or joints."""

from __future__ import annotations

from itertools import chain

from . import iso6983
from .iso6983 import axis_words, rotary_zero
from .program import Program
from .writing import description, first_rotary, rotary_names

FILE_ENDING = ".nc"
DIALECT = "fanuc"
JOINTS = True
OPTIONS = iso6983.OPTIONS | {"program_number"}
VECTOR = ("I", "J", "K")


def write(first: Program, *more: Program, vectors: bool = False) -> str:
    """Every number has a decimal point: without one the control reads thousandths. No block numbers. more: what follows
    with other tools."""
    comment = description(first) if first.options.comments else ""
    head = f"O{first.options.program_number:04d} ({first.name} - {comment})"
    sections = chain.from_iterable(_section(program, vectors) for program in (first, *more))
    return "\r\n".join(["%", head, *sections, "M30", "%", ""])


def _section(program: Program, vectors: bool) -> list[str]:
    """All blocks with one tool."""
    moves = iso6983.moves(program, "({})", VECTOR if vectors else None)
    opening = _opening_tcp(program, vectors) if program.tcp else _opening_joints(program)
    return [*_start(program), *opening, *moves, *_closing(program)]


def _start(program: Program) -> list[str]:
    start = rotary_zero(program)
    if not program.tcp:
        start = axis_words(program, rotary_names(program), first_rotary(program))
    coolant = program.options.coolant_word
    return [
        "G21 G17 G40 G49 G80 G90 G94",
        "G91 G28 Z0.",
        f"T{program.tool.number} M6",
        f"G90 G54 G0 {start}",
        f"S{program.spindle_rpm:.0f} {program.spindle_word}",
        *([coolant] if coolant else []),
        f"G0 {axis_words(program, 'XY', program.xyz_mm[0, :2])}",
    ]


def _opening_tcp(program: Program, vectors: bool) -> list[str]:
    above = axis_words(program, "Z", (program.xyz_mm[0, 2] + program.options.preposition_mm,))
    angles = axis_words(program, rotary_names(program), first_rotary(program))
    return [
        f"{'G43.5' if vectors else 'G43.4'} H{program.tool.number} {above}",
        f"G0 {iso6983.vector_words(program, VECTOR) if vectors else angles}",
    ]


def _opening_joints(program: Program) -> list[str]:
    z = axis_words(program, "Z", program.xyz_mm[0, 2:])
    return [f"G43 H{program.tool.number} {z}", iso6983.INVERSE_TIME]


def _closing(program: Program) -> list[str]:
    per_minute = [] if program.tcp else [iso6983.PER_MINUTE]
    return [*per_minute, "G49", "G91 G28 Z0.", f"G90 G0 {rotary_zero(program)}", "M9", "M5"]
