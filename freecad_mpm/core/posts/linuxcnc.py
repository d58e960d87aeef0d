"""LinuxCNC: tip coordinates and rotary angles with the machine's kinematics switched on (M428), or joint positions;
inverse-time feed."""

from __future__ import annotations

from itertools import chain

from . import iso6983
from .iso6983 import axis_words, rotary_zero
from .program import Program
from .writing import description, first_rotary, rotary_names

FILE_ENDING = ".ngc"
DIALECT = "linuxcnc"
JOINTS = True
OPTIONS = iso6983.OPTIONS | {"path_tolerance_mm"}


def write(first: Program, *more: Program) -> str:
    """M428 and M429 are the words of LinuxCNC's own five-axis configurations, which a program of joint positions does
    not need. Datum G54 is the part's. more: what follows with other tools."""
    head = f"({first.name} - {description(first) if first.options.comments else ''})"
    sections = chain.from_iterable(_section(program) for program in (first, *more))
    return "\n".join([head, *sections, "M30", ""])


def _section(program: Program) -> list[str]:
    """All blocks with one tool."""
    moves = iso6983.moves(program, "({})", inverse_time=True)
    opening = _opening_tcp(program) if program.tcp else _opening_joints(program)
    return [*_start(program), *opening, *moves, *_closing(program)]


def _start(program: Program) -> list[str]:
    options, tool = program.options, program.tool.number
    start = rotary_zero(program) if program.tcp else _first_turn(program)
    return [
        "G21 G17 G40 G49 G80 G90 G94",
        _path_mode(program),
        *(["M429"] if program.tcp else []),
        _retract(program),
        f"T{tool} M6",
        f"G54 G43 H{tool}",
        f"G0 {start}",
        f"S{program.spindle_rpm:.0f} {program.spindle_word}",
        *([options.coolant_word] if options.coolant_word else []),
    ]


def _path_mode(program: Program) -> str:
    """Exact unless a tolerance is given: left alone the control rounds corners by as much as its speed asks for."""
    tolerance = program.options.path_tolerance_mm
    return f"G64 P{tolerance:g} Q{tolerance:g}" if tolerance else "G61"


def _opening_tcp(program: Program) -> list[str]:
    x, y, z = program.xyz_mm[0].tolist()
    return [
        "M428",
        f"G0 {axis_words(program, 'XY', (x, y))}",
        f"G0 {axis_words(program, 'Z', (z + program.options.preposition_mm,))}",
        f"G0 {_first_turn(program)}",
        iso6983.INVERSE_TIME,
    ]


def _opening_joints(program: Program) -> list[str]:
    x, y, z = program.xyz_mm[0].tolist()
    return [
        f"G0 {axis_words(program, 'XY', (x, y))}",
        f"G0 {axis_words(program, 'Z', (z,))}",
        iso6983.INVERSE_TIME,
    ]


def _first_turn(program: Program) -> str:
    return axis_words(program, rotary_names(program), first_rotary(program))


def _closing(program: Program) -> list[str]:
    off = ["M429"] if program.tcp else []
    return [iso6983.PER_MINUTE, *off, _retract(program), f"G0 {rotary_zero(program)}", "M9", "M5"]


def _retract(program: Program) -> str:
    return f"G53 G0 {axis_words(program, 'Z', (program.machine.setup.retract_z_mm,))}"
