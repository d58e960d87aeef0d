"""APT cutter locations: tips and tool axes for other people's posts, free of any control and machine."""

from __future__ import annotations

from .program import Program
from .writing import VECTOR_DECIMALS, Step, description, number, steps

FILE_ENDING = ".apt"
DIALECT = "apt"


def write(program: Program) -> str:
    lines = [f"PARTNO/{program.name}", f"PPRINT/{description(program)}", "UNITS/MM", "MULTAX/ON"]
    lines += [f"LOADTL/{program.tool.number}", f"SPINDL/RPM,{program.spindle_rpm:.0f},CLW"]
    lines += ["COOLNT/ON"] if program.coolant else []
    for step in steps(program):
        lines += _move(step)
    return "\n".join([*lines, "COOLNT/OFF", "SPINDL/OFF", "FINI", ""])


def _move(step: Step) -> list[str]:
    pose = [number(value) for value in step.tip] + [number(value, VECTOR_DECIMALS) for value in step.axis]
    before = ["RAPID"] if step.rapid else [f"FEDRAT/MMPM,{number(step.feed)}"] if step.new_feed else []
    return [*before, f"GOTO/{','.join(pose)}"]
