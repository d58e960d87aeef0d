"""Colours of tool and machine, the same in pictures and in a window."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ..machine import Machine
from .bodies import RAM

Colour = tuple[float, float, float]

TOOL_COLOURS: Mapping[str, Colour] = {
    "ring": (0.86, 0.55, 0.10),
    "flutes": (0.90, 0.74, 0.36),
    "shank": (0.62, 0.65, 0.70),
    "holder": (0.42, 0.46, 0.53),
}
TABLE_COLOUR: Colour = (0.55, 0.68, 0.62)
HEAD_COLOUR: Colour = (0.50, 0.60, 0.75)
RAM_COLOUR: Colour = (0.75, 0.77, 0.80)


def table_letters(machine: Machine) -> list[str]:
    """Of the rotary axes that carry the part."""
    return [axis.name for axis in machine.rotary_axes if axis.role == "table_rotary"]


def colour_of(body: str, tables: Sequence[str]) -> Colour:
    """Of a body of the machine with these tables."""
    if body == RAM:
        return RAM_COLOUR
    return TABLE_COLOUR if body in tables else HEAD_COLOUR
