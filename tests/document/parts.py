"""Parts that the document tests machine."""

from __future__ import annotations

import math
from typing import Any

import Part
from FreeCAD import Vector

TOP = "Face5"
# Steps that give some thirty positions: the chain matters here, not the path.
COARSE = {"SideStep": "15 mm", "ForwardStep": "6 mm"}


def wave(width: float = 60, depth: float = 40, height: float = 2.0) -> Any:
    """A B-spline surface over 0..width, 0..depth, as FreeCAD's Part.BSplineSurface."""
    rows = [
        [Vector(x, y, height * math.sin(x / 12) * math.cos(y / 15)) for y in steps(depth)]
        for x in steps(width)
    ]
    surface = Part.BSplineSurface()
    surface.interpolate(rows)
    return surface


def steps(length: float, count: int = 7) -> list[float]:
    return [length * i / (count - 1) for i in range(count)]


def free_form_block(doc: Any, name: str = "Block") -> Any:
    block = doc.addObject("Part::Feature", name)
    block.Shape = wave().toShape().extrude(Vector(0, 0, -15))
    doc.recompute()
    assert block.Shape.getElement(TOP).CenterOfMass.z > -2  # the others lie lower
    return block
