"""A sketch of a machine for looking at: discs, bearings and cylinders in the right places, sizes by the part and tool.

A machine file knows axes, no castings: nothing here may be used to judge a collision."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np

from ..base import Floats
from ..job import ToolSpec
from ..machine import Machine, RotaryAxis
from .bodies import RAM, SPINDLE, translation, turned_to, unit
from .tool_solid import Mesh, length_mm, reach_mm, revolved

# Two directions nearer than this (cosine) count as one beside the other: the sketch then stacks instead of flanking.
ALONG = 0.9
# An axis flatter than this (cosine to the table's) is held on both sides, a steeper one from below.
FLAT = 0.5
# Sizes in radii of the table.
TABLE_MARGIN, TABLE_THICKNESS, BEARING_RADIUS, BEARING_WIDTH, STRUT_RADIUS = 1.1, 0.12, 0.22, 0.2, 0.06
# Sizes in radii of the spindle, which is this much wider than the tool.
SPINDLE_MARGIN, SPINDLE_LENGTH, HEAD_LENGTH, HEAD_RADIUS, RAM_LENGTH = 1.25, 3.0, 1.6, 0.8, 2.5


def sketch(machine: Machine, part_box: tuple[Floats, Floats], tool: ToolSpec) -> dict[str, Mesh]:
    """Body -> its mesh, in the frames of `bodies.body_matrices`: tables in the set-up frame, heads, spindle and
    ram from the gauge point. part_box: low and high corner of the part in the set-up frame."""
    tables = [axis for axis in machine.rotary_axes if axis.role == "table_rotary"]
    heads = [axis for axis in machine.rotary_axes if axis.role == "head_rotary"]
    return _tables(tables, np.asarray(machine.setup.part_origin_mm), part_box) | _heads(machine, heads, tool)


def _tables(
    tables: Sequence[RotaryAxis], part_origin: Floats, part_box: tuple[Floats, Floats]
) -> dict[str, Mesh]:
    """A disc under the part; the axis that carries it has bearings, and struts from them to the disc."""
    if not tables:
        return {}
    axis = _upward(tables[0])
    if axis[2] < FLAT:
        axis = np.array([0.0, 0.0, 1.0])  # a plate that swings: it still lies under the part
    origin = np.asarray(tables[0].joint_origin_mm) - part_origin
    corners = np.array(list(product(*zip(*part_box)))) - origin
    along = corners @ axis
    radius = TABLE_MARGIN * float(np.linalg.norm(corners - np.outer(along, axis), axis=1).max())
    top = origin + along.min() * axis
    bottom = top - TABLE_THICKNESS * radius * axis
    result = {tables[0].name: cylinder(bottom, top, radius)}
    for carrier in tables[1:]:
        origin = np.asarray(carrier.joint_origin_mm) - part_origin
        result[carrier.name] = joined(list(_cradle(carrier, origin, axis, bottom, radius)))
    return result


def _cradle(
    carrier: RotaryAxis, origin: Floats, table_axis: Floats, underside: Floats, radius: float
) -> Iterator[Mesh]:
    direction = unit(carrier.rotation_vector)
    slope = float(direction @ table_axis)
    middle = origin + ((underside - origin) @ direction) * direction
    width = BEARING_WIDTH * radius
    low = underside - STRUT_RADIUS * radius * table_axis
    for side in (-1.0, 1.0):
        if abs(slope) > FLAT and side * slope > 0:
            continue  # it would stand in the part's way
        inner = middle + side * (radius + width) * direction
        corner = inner - ((inner - low) @ table_axis) * table_axis
        yield cylinder(inner, inner + side * width * direction, BEARING_RADIUS * radius)
        yield cylinder(inner, corner, STRUT_RADIUS * radius)
        yield cylinder(corner, low, STRUT_RADIUS * radius)


def _heads(machine: Machine, heads: Sequence[RotaryAxis], tool: ToolSpec) -> dict[str, Mesh]:
    """From the spindle up: a cylinder for it, one along the axis of each head, and the ram."""
    axis = unit(machine.kinematics.spindle_axis)
    radius = SPINDLE_MARGIN * reach_mm(tool)
    nose = (length_mm(tool) - machine.setup.tool_length_mm) * axis  # at the top of the tool, wherever that is
    end = nose + SPINDLE_LENGTH * radius * axis
    result = {SPINDLE: cylinder(nose, end, radius)}
    for head in reversed(heads):
        result[head.name], end = _head(head, axis, end, radius)
    result[RAM] = cylinder(end, end + RAM_LENGTH * radius * axis, radius)
    return result


def _head(head: RotaryAxis, spindle_axis: Floats, end: Floats, radius: float) -> tuple[Mesh, Floats]:
    """The head's mesh and where what carries it is joined on."""
    direction = _upward(head)
    if direction @ spindle_axis > ALONG:
        top = end + HEAD_LENGTH / 2 * radius * direction
        return cylinder(end, top, radius), top
    origin = np.asarray(head.joint_origin_mm)
    pivot = origin + ((end - origin) @ direction) * direction
    far = pivot + HEAD_LENGTH * radius * direction
    return (
        joined([cylinder(pivot, far, HEAD_RADIUS * radius), cylinder(end, pivot, HEAD_RADIUS * radius)]),
        far,
    )


def _upward(axis: RotaryAxis) -> Floats:
    """The axis' direction, the one of the two that does not point down."""
    direction = unit(axis.rotation_vector)
    return -direction if direction[2] < 0 else direction


def cylinder(start: Floats, end: Floats, radius: float) -> Mesh:
    """A closed cylinder from `start` to `end`; nothing when they are the same."""
    length = float(np.linalg.norm(end - start))
    if length == 0:
        return Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64))
    outline = np.array([(0.0, 0.0), (radius, 0.0), (radius, length), (0.0, length)])
    return revolved(outline).moved(translation(start) @ turned_to((end - start) / length))


def joined(meshes: Sequence[Mesh]) -> Mesh:
    """All in one."""
    starts = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    triangles = [mesh.triangles + start for mesh, start in zip(meshes, starts)]
    return Mesh(np.concatenate([mesh.points for mesh in meshes]), np.concatenate(triangles))
