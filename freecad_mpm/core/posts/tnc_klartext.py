"""Klartext for a HEIDENHAIN TNC: tip coordinates and rotary angles under M128."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Literal

from .program import Program
from .writing import (
    LINEAR_DECIMALS,
    PREPOSITION_MM,
    VECTOR_DECIMALS,
    Step,
    description,
    rotary_zero,
    signed,
    steps,
)

FILE_ENDING = ".H"
DIALECT = "klartext"
MAX_BLANK_RATIO = 200.0  # the control's picture takes no blank with sides over this ratio


@dataclass(frozen=True)
class Options:
    tcp_on: str = "M128"
    tcp_off: str = "M129"
    orientation: Literal["angles", "vectors"] = "angles"


def write(program: Program, options: Options = Options()) -> str:
    """The program as text with CRLF line ends, ASCII, its blocks numbered from 0."""
    name = program.name
    blocks = [f"BEGIN PGM {name} MM", *_opening(program, options), *_moves(program, options)]
    blocks += [*_closing(program, options), f"END PGM {name} MM"]
    return "\r\n".join([*(f"{i} {block}" for i, block in enumerate(blocks)), ""])


def _opening(program: Program, options: Options) -> list[str]:
    first = next(steps(program))
    x, y, z = first.tip
    above = replace(first, tip=[x, y, z + PREPOSITION_MM], turns=True, travels=False)
    return [
        *_blank(program),
        f"; {description(program)}",
        options.tcp_off,
        _retract(program),
        f"TOOL CALL {program.tool.number} Z S{program.spindle_rpm:.0f}",
        f"L {_words(rotary_zero(program))} R0 FMAX M126",
        f"L X{signed(x)} Y{signed(y)} R0 FMAX M3",
        f"L Z{signed(z + PREPOSITION_MM)} R0 FMAX" + (" M8" if program.coolant else ""),
        options.tcp_on,
        _move(above, options),
    ]


def _moves(program: Program, options: Options) -> Iterator[str]:
    return (_move(step, options) for step in steps(program))


def _move(step: Step, options: Options) -> str:
    feed = " FMAX" if step.rapid else f" F{step.feed:g}" if step.new_feed else ""
    tip = _words(zip("XYZ", step.tip))
    if options.orientation == "vectors":
        vector = _words(zip(("TX", "TY", "TZ"), step.axis), VECTOR_DECIMALS)
        return f"LN {tip} {vector}{feed}"
    words = [tip] if step.travels or not step.rapid else []
    words += [_words(step.rotary)] if step.turns else []
    return f"L {' '.join(words or [tip])}{feed}"


def _closing(program: Program, options: Options) -> list[str]:
    return [
        options.tcp_off,
        _retract(program),
        f"L {_words(rotary_zero(program))} R0 FMAX M5",
        "M30",
    ]


def _retract(program: Program) -> str:
    return f"L Z{signed(program.machine.setup.retract_z_mm)} R0 FMAX M91"


def _blank(program: Program) -> list[str]:
    if program.blank is None:
        return []
    low, high = program.blank
    sides = high - low
    if sides.min() <= 0 or sides.max() >= MAX_BLANK_RATIO * sides.min():
        return []
    return [
        f"BLK FORM 0.1 Z {_words(zip('XYZ', low.tolist()))}",
        f"BLK FORM 0.2 {_words(zip('XYZ', high.tolist()))}",
    ]


def _words(pairs: Iterable[tuple[str, float]], decimals: int = LINEAR_DECIMALS) -> str:
    return " ".join(f"{letter}{signed(value, decimals)}" for letter, value in pairs)
