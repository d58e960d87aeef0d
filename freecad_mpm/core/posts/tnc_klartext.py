"""Klartext for a HEIDENHAIN TNC: tip coordinates and rotary angles under M128, or joint positions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import chain

from ..base import Floats
from . import tnc
from .program import Program
from .writing import VECTOR_DECIMALS, description, first_rotary, move_lines, rotary_names, with_stops, words

FILE_ENDING = ".H"
DIALECT = "klartext"
JOINTS = True
OPTIONS = tnc.OPTIONS


@dataclass(frozen=True)
class Form:
    """What the posts for this dialect differ in."""

    tcp_on: str = "M128"
    tcp_off: str = "M129"
    vectors: bool = False


def write(first: Program, *more: Program, form: Form = Form()) -> str:
    """The program as text with CRLF line ends, ASCII, its blocks numbered from 0; more: what follows with other
    tools."""
    name = first.name
    sections = chain.from_iterable(_section(program, form) for program in (first, *more))
    blocks = [f"BEGIN PGM {name} MM", *_blank(first), *sections, "M30", f"END PGM {name} MM"]
    return "\r\n".join([*(f"{i} {block}" for i, block in enumerate(blocks)), ""])


def _section(program: Program, form: Form) -> list[str]:
    """All blocks with one tool."""
    style = tnc.style(program, *(("LN", "LN") if form.vectors else ("L", "L")), " FMAX", form.vectors)
    moves = with_stops(program, move_lines(program, style), "M0", "; {}")
    return [*_opening(program, form), *moves, *_closing(program, form)]


def _opening(program: Program, form: Form) -> list[str]:
    options, rotary = program.options, rotary_names(program)
    x, y, z = program.xyz_mm[0].tolist()
    start: Sequence[float] = (0.0, 0.0) if program.tcp else first_rotary(program)
    above = z + options.preposition_mm if program.tcp else z
    blocks = [
        *([f"; {description(program)}"] if options.comments else []),
        form.tcp_off,
        _retract(program),
        f"TOOL CALL {program.tool.number} Z S{program.spindle_rpm:.0f}",
        *_tolerance(program),
        f"L {_words(program, rotary, start)} R0 FMAX M126",
        f"L {_words(program, 'XY', (x, y))} R0 FMAX {program.spindle_word}",
        " ".join(filter(None, (f"L {_words(program, 'Z', (above,))} R0 FMAX", options.coolant_word))),
    ]
    return blocks + ([form.tcp_on, _turn_above(program, form, (x, y, above))] if program.tcp else [])


def _turn_above(program: Program, form: Form, place: Sequence[float]) -> str:
    """The first turn, over the first pose with the tip held."""
    if not form.vectors:
        return f"L {_words(program, rotary_names(program), first_rotary(program))} FMAX"
    vector = words(("TX", "TY", "TZ"), program.moves.axis[0], tnc.VECTOR, VECTOR_DECIMALS)
    return f"LN {_words(program, 'XYZ', place)} {vector} FMAX"


def _closing(program: Program, form: Form) -> list[str]:
    return [
        *(["L M140 MB MAX FMAX"] if program.options.retract == "tool_axis" else []),
        form.tcp_off,
        _retract(program),
        f"L {_words(program, rotary_names(program), (0.0, 0.0))} R0 FMAX M5",
    ]


def _retract(program: Program) -> str:
    return f"L {_words(program, 'Z', (program.machine.setup.retract_z_mm,))} R0 FMAX M91"


def _tolerance(program: Program) -> list[str]:
    """Cycle 32: how far the control may leave the path to go smoothly; TA is what its rotary axes may be off."""
    options = program.options
    if not options.path_tolerance_mm:
        return []
    mode = 0 if options.smoothing == "finish" else 1
    return [
        "CYCL DEF 32.0 TOLERANCE",
        f"CYCL DEF 32.1 T{options.path_tolerance_mm:g}",
        f"CYCL DEF 32.2 HSC-MODE:{mode} TA{options.rotary_tolerance_deg:g}",
    ]


def _blank(program: Program) -> list[str]:
    corners = tnc.blank(program)
    if corners is None:
        return []
    heads = ("BLK FORM 0.1 Z", "BLK FORM 0.2")
    return [f"{head} {_words(program, 'XYZ', corner)}" for head, corner in zip(heads, corners)]


def _words(program: Program, names: Sequence[str], values: Floats | Sequence[float]) -> str:
    return words(names, values, tnc.LENGTH, program.options.decimals)
