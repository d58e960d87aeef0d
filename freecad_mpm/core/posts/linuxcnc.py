"""LinuxCNC: tip coordinates and rotary angles with the machine's kinematics switched on (M428), inverse-time feed."""

from __future__ import annotations

from collections.abc import Iterable

from .program import Program
from .writing import PREPOSITION_MM, Step, description, number, rotary_zero, steps

FILE_ENDING = ".ngc"
DIALECT = "linuxcnc"
INVERSE_TIME_DECIMALS = 4


def write(program: Program) -> str:
    """M428 and M429 are the words of LinuxCNC's own five-axis configurations. Datum G54 is the part's."""
    return "\n".join([*_opening(program), *(_move(step) for step in steps(program)), *_closing(program), ""])


def _opening(program: Program) -> list[str]:
    first = next(steps(program))
    x, y, z = first.tip
    tool = program.tool.number
    return [
        f"({program.name} - {description(program)})",
        "G21 G17 G40 G49 G80 G90 G94",
        "M429",
        _retract(program),
        f"T{tool} M6",
        f"G54 G43 H{tool}",
        f"G0 {_words(rotary_zero(program))}",
        f"S{program.spindle_rpm:.0f} M3",
        *(["M8"] if program.coolant else []),
        "M428",
        f"G0 X{number(x)} Y{number(y)}",
        f"G0 Z{number(z + PREPOSITION_MM)}",
        f"G0 {_words(first.rotary)}",
        "G93",
    ]


def _move(step: Step) -> str:
    words = [_words(zip("XYZ", step.tip))] if step.travels or not step.rapid else []
    words += [_words(step.rotary)] if step.turns else []
    if step.rapid:
        return "G0 " + " ".join(words or [_words(zip("XYZ", step.tip))])
    return f"G1 {' '.join(words)} F{number(1.0 / step.minutes, INVERSE_TIME_DECIMALS)}"


def _closing(program: Program) -> list[str]:
    return ["G94", "M429", _retract(program), f"G0 {_words(rotary_zero(program))}", "M9", "M5", "M30"]


def _retract(program: Program) -> str:
    return f"G53 G0 Z{number(program.machine.setup.retract_z_mm)}"


def _words(pairs: Iterable[tuple[str, float]]) -> str:
    return " ".join(f"{letter}{number(value)}" for letter, value in pairs)
