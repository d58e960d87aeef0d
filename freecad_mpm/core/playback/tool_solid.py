"""The tool as a solid of revolution: the outline of its half section, and the triangles that it sweeps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base import Floats, Integers
from ..job import Segment, ToolSpec

# The ring's arc is cut into pieces of at most so many degrees, the turn about the axis into so many facets.
ARC_STEP_DEG = 7.5
FACETS = 48


@dataclass(frozen=True)
class Outline:
    """A piece of the half section: `points` (K, 2) are radius and height above the tip, from below upwards."""

    part: str  # ring, flutes, shank or holder
    points: Floats


@dataclass(frozen=True)
class Mesh:
    """Triangles (T, 3) by their rows in `points` (V, 3), counter-clockwise seen from outside; mm."""

    points: Floats
    triangles: Integers

    @property
    def corners(self) -> Floats:
        """(T, 3, 3): the triangles' corners."""
        return np.asarray(self.points[self.triangles])

    def moved(self, matrix: Floats) -> Mesh:
        """The mesh carried by a matrix (4, 4) that does not mirror."""
        return Mesh(self.points @ matrix[:3, :3].T + matrix[:3, 3], self.triangles)


def outlines(tool: ToolSpec) -> list[Outline]:
    """The half section in pieces, each beginning where the one before ends; the first begins and the last ends on the
    axis, so that together they enclose the tool. A tool without shank or holder lacks their pieces."""
    ring = _ring(tool)
    height = tool.flute_length_mm
    pieces = [Outline("ring", ring), Outline("flutes", _piece(ring[-1], [(tool.radius_mm, height)]))]
    for part, segments in (("shank", tool.shank), ("holder", tool.holder)):
        if segments:
            pieces.append(Outline(part, _piece(pieces[-1].points[-1], _stacked(segments, height))))
            height += sum(one.length_mm for one in segments)
    lid = _piece(pieces[-1].points[0], [*pieces[-1].points[1:], np.array((0.0, height))])
    return [*pieces[:-1], Outline(pieces[-1].part, lid)]


def meshes(tool: ToolSpec, facets: int = FACETS) -> dict[str, Mesh]:
    """The tool's pieces by name, tip at the origin, axis along +z."""
    return {outline.part: revolved(outline.points, facets) for outline in outlines(tool)}


def length_mm(tool: ToolSpec) -> float:
    """From the tip to the top of the last segment."""
    return tool.flute_length_mm + sum(one.length_mm for one in (*tool.shank, *tool.holder))


def reach_mm(tool: ToolSpec) -> float:
    """Largest distance of a point of the tool from its axis."""
    return float(max(outline.points[:, 0].max() for outline in outlines(tool)))


def revolved(points: Floats, facets: int = FACETS) -> Mesh:
    """The surface that `points` (K, 2), radius and height, sweep about the z axis: a body on their left side, as seen
    with the radius to the right, has its outside outside. The corners are on the true surface."""
    angle = 2 * np.pi * np.arange(facets) / facets
    radius, height = points[:, :1], np.broadcast_to(points[:, 1:], (len(points), facets))
    nodes = np.stack((radius * np.cos(angle), radius * np.sin(angle), height), axis=-1)
    index = np.arange(len(points) * facets).reshape(len(points), facets)
    a, b = index[:-1], np.roll(index[:-1], -1, axis=1)
    c, d = np.roll(index[1:], -1, axis=1), index[1:]
    lower, upper = np.stack((a, b, c), axis=-1), np.stack((a, c, d), axis=-1)
    on_axis = points[:, 0] == 0  # there a facet is one triangle
    triangles = np.concatenate((lower[~on_axis[:-1]].reshape(-1, 3), upper[~on_axis[1:]].reshape(-1, 3)))
    return Mesh(nodes.reshape(-1, 3), triangles)


def _ring(tool: ToolSpec) -> Floats:
    """From the axis over the bottom, with its hollow, round the minor circle to the cutter's full radius."""
    major, minor = tool.major_radius_mm, tool.minor_radius_mm
    if minor == 0:
        return np.array([(0.0, 0.0), (major, 0.0)])
    # Angle on the minor circle where the hollow's ceiling, or before it the axis, is met; -pi is nearest to the axis.
    ceiling = -np.pi + np.arcsin((minor - tool.recess_mm) / minor)
    axis = -np.arccos(max(-major / minor, -1.0))
    start = max(ceiling, axis)
    angle = np.linspace(start, 0.0, 1 + int(np.ceil(np.degrees(-start) / ARC_STEP_DEG)))
    arc = np.column_stack((major + minor * np.cos(angle), minor + minor * np.sin(angle)))
    if axis >= ceiling:
        arc[0, 0] = 0.0  # without the rounding error of the cosine
        return arc
    return np.vstack(((0.0, tool.recess_mm), arc))


def _stacked(segments: Sequence[Segment], height: float) -> list[tuple[float, float]]:
    corners = []
    for one in segments:
        corners += [(one.bottom_radius_mm, height), (one.top_radius_mm, height + one.length_mm)]
        height += one.length_mm
    return corners


def _piece(start: Floats, rest: Sequence[Sequence[float] | Floats]) -> Floats:
    """The polyline without points that repeat the one before."""
    points = np.array([start, *rest])
    return points[np.append(True, (np.diff(points, axis=0) != 0).any(axis=1))]
