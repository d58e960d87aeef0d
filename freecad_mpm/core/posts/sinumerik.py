"""Siemens 840D: TRAORI with rotary angles (ORIAXES) or with the tool's direction as a vector (ORIVECT)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from .program import Program
from .writing import (
    LINEAR_DECIMALS,
    PREPOSITION_MM,
    VECTOR_DECIMALS,
    Step,
    description,
    number,
    rotary_zero,
    steps,
)

FILE_ENDING = ".MPF"
DIALECT = "sinumerik"


@dataclass(frozen=True)
class Options:
    orientation: Literal["angles", "vectors"] = "angles"


def write(program: Program, options: Options = Options()) -> str:
    """The datum is G54; a rotary axis that goes over 360 degrees must not be a modulo axis of the control."""
    blocks = [*_opening(program, options), *_moves(program, options), *_closing(program)]
    return "\n".join([f"; {program.name} - {description(program)}", *_numbered(blocks), ""])


def _opening(program: Program, options: Options) -> list[str]:
    first = next(steps(program))
    x, y, z = first.tip
    return [
        "G17 G40 G71 G90 G94",
        "TRAFOOF",
        _retract(program),
        f"T{program.tool.number} M6",
        f"S{program.spindle_rpm:.0f} M3" + (" M8" if program.coolant else ""),
        f"G54 D1 G0 {_words(rotary_zero(program))}",
        "TRAORI",
        "G54",
        "ORIWKS ORIVECT" if options.orientation == "vectors" else "ORIMKS ORIAXES",
        f"G0 X{number(x)} Y{number(y)}",
        f"G0 Z{number(z + PREPOSITION_MM)}",
        f"G0 {_direction(first, options)}",
    ]


def _moves(program: Program, options: Options) -> Iterator[str]:
    return (_move(step, options) for step in steps(program))


def _move(step: Step, options: Options) -> str:
    words = ["G0" if step.rapid else "G1"]
    words += [_words(zip("XYZ", step.tip))] if step.travels or not step.turns or not step.rapid else []
    words += [_direction(step, options)] if step.turns else []
    words += [f"F{step.feed:g}"] if step.new_feed else []
    return " ".join(words)


def _direction(step: Step, options: Options) -> str:
    if options.orientation == "angles":
        return _words(step.rotary)
    return _words(zip(("A3=", "B3=", "C3="), step.axis), VECTOR_DECIMALS)


def _closing(program: Program) -> list[str]:
    return ["TRAFOOF", _retract(program), f"G0 {_words(rotary_zero(program))}", "M9", "M5", "M30"]


def _retract(program: Program) -> str:
    return f"SUPA G0 Z{number(program.machine.setup.retract_z_mm)} D0"


def _numbered(blocks: Iterable[str]) -> Iterator[str]:
    return (f"N{10 * i} {block}" for i, block in enumerate(blocks, 1))


def _words(pairs: Iterable[tuple[str, float]], decimals: int = LINEAR_DECIMALS) -> str:
    return " ".join(f"{letter}{number(value, decimals)}" for letter, value in pairs)
