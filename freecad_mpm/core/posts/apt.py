"""APT cutter locations: tips and tool axes for other people's posts, free of any control and machine."""

from __future__ import annotations

from itertools import chain

from .program import Program
from .writing import VECTOR_DECIMALS, Style, description, move_table, with_stops

FILE_ENDING = ".apt"
DIALECT = "apt"
JOINTS = False
OPTIONS = frozenset({"decimals", "coolant"})


def write(first: Program, *more: Program) -> str:
    """more: what follows with other tools."""
    head = [f"PARTNO/{first.name}", f"PPRINT/{description(first)}", "UNITS/MM", "MULTAX/ON"]
    sections = chain.from_iterable(_section(program) for program in (first, *more))
    return "\n".join([*head, *sections, "FINI", ""])


def _section(program: Program) -> list[str]:
    """All statements with one tool."""
    spindle = f"SPINDL/RPM,{program.spindle_rpm:.0f},CLW" if program.spindle_on else "SPINDL/OFF"
    lines = [f"LOADTL/{program.tool.number}", spindle]
    lines += [] if program.options.coolant == "off" else ["COOLNT/ON"]
    return [*lines, *_moves(program), "COOLNT/OFF", "SPINDL/OFF"]


def _moves(program: Program) -> list[str]:
    length, part = f"%.{program.options.decimals}f", f"%.{VECTOR_DECIMALS}f"
    style = Style("RAPID", "", length, ("I", "J", "K"), part, vectors=True, whole=True)
    table, form = move_table(program, style), "GOTO/" + ",".join((length,) * 3 + (part,) * 3)
    lines = []
    for rapid, new_feed, feed, xyz, axis in zip(
        table.rapid.tolist(),
        table.show_feed.tolist(),
        table.feed.tolist(),
        table.xyz.tolist(),
        table.turn.tolist(),
    ):
        before = "RAPID\n" if rapid else f"FEDRAT/MMPM,{feed:.3f}\n" if new_feed else ""
        lines.append(before + form % (*xyz, *axis))
    return with_stops(program, lines, "STOP", "PPRINT/{}")
