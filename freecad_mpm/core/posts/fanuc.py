"""Fanuc 30i class: tool-centre-point control with rotary angles (G43.4) or with the tool's direction (G43.5)."""

from __future__ import annotations

from collections.abc import Iterable
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

FILE_ENDING = ".nc"
DIALECT = "fanuc"


@dataclass(frozen=True)
class Options:
    orientation: Literal["angles", "vectors"] = "angles"
    program_number: int = 1


def write(program: Program, options: Options = Options()) -> str:
    """Every number has a decimal point: without one the control reads thousandths. No block numbers."""
    head = ["%", f"O{options.program_number:04d} ({program.name} - {description(program)})"]
    moves = [_move(step, options) for step in steps(program)]
    return "\r\n".join([*head, *_opening(program, options), *moves, *_closing(program), "%", ""])


def _opening(program: Program, options: Options) -> list[str]:
    first = next(steps(program))
    x, y, z = first.tip
    tool = program.tool.number
    return [
        "G21 G17 G40 G49 G80 G90 G94",
        "G91 G28 Z0.",
        f"T{tool} M6",
        f"G90 G54 G0 {_words(rotary_zero(program))}",
        f"S{program.spindle_rpm:.0f} M3",
        *(["M8"] if program.coolant else []),
        f"G0 X{number(x)} Y{number(y)}",
        f"{'G43.5' if options.orientation == 'vectors' else 'G43.4'} H{tool} Z{number(z + PREPOSITION_MM)}",
        f"G0 {_direction(first, options)}",
    ]


def _move(step: Step, options: Options) -> str:
    words = ["G0" if step.rapid else "G1"]
    words += [_words(zip("XYZ", step.tip))] if step.travels or not step.turns or not step.rapid else []
    words += [_direction(step, options)] if step.turns else []
    words += [f"F{number(step.feed)}"] if step.new_feed else []
    return " ".join(words)


def _direction(step: Step, options: Options) -> str:
    if options.orientation == "angles":
        return _words(step.rotary)
    return _words(zip("IJK", step.axis), VECTOR_DECIMALS)


def _closing(program: Program) -> list[str]:
    return ["G49", "G91 G28 Z0.", f"G90 G0 {_words(rotary_zero(program))}", "M9", "M5", "M30"]


def _words(pairs: Iterable[tuple[str, float]], decimals: int = LINEAR_DECIMALS) -> str:
    return " ".join(f"{letter}{number(value, decimals)}" for letter, value in pairs)
