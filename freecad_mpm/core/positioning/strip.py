"""The strip that one position machines: where the tool is within a scallop height of the faces, seen along the feed.

For each distance across the feed the least gap between tool and surface counts, wherever along the feed it is: while the
tool goes on, that place comes by. The gap is the distance of surface points from the tool, so nothing is assumed of the
ground between the contacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ... import _core
from ..base import Floats
from ..part import FaceArrays

# Surface points are this far apart, against the cutter's radius: the gap grows with the square of what is missed.
STEP_PER_RADIUS = 1 / 64
# A face's parameters are first looked at on a net of so many lines each way to find where the tool is.
COARSE = 65


@dataclass(frozen=True)
class Ground:
    """Surface points (M, 3) round one footprint point, mm, in the set-up frame."""

    points: Floats


def ground_under(faces: list[FaceArrays], at: Floats, radius_mm: float) -> Ground:
    """The points of `faces` (set-up frame, trims ignored) within a cutter's diameter of `at` (2,) in plan."""
    found = [_points_near(face, at, 2 * radius_mm, STEP_PER_RADIUS * radius_mm) for face in faces]
    return Ground(np.concatenate(found))


def _points_near(face: FaceArrays, at: Floats, reach: float, step: float) -> Floats:
    surface = _core.BSplineSurface(
        face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights
    )
    u0, u1, v0, v1 = surface.domain
    u, v = np.linspace(u0, u1, COARSE), np.linspace(v0, v1, COARSE)
    net = _net(surface, u, v)
    spread = max(np.abs(np.diff(net, axis=0)).max(), np.abs(np.diff(net, axis=1)).max())
    near = np.linalg.norm(net[..., :2] - at, axis=2) <= reach + spread
    if not near.any():
        return np.empty((0, 3))
    u_near, v_near = np.flatnonzero(near.any(axis=1)), np.flatnonzero(near.any(axis=0))
    u_range, v_range = u[u_near[[0, -1]]], v[v_near[[0, -1]]]
    lines = int(np.ceil((2 * reach + 2 * spread) / step)) + 1
    across = np.linspace(u_range[0], u_range[1], lines), np.linspace(v_range[0], v_range[1], lines)
    points = _net(surface, *across).reshape(-1, 3)
    return points[np.linalg.norm(points[:, :2] - at, axis=1) <= reach]


def _net(surface: _core.BSplineSurface, u: Floats, v: Floats) -> Floats:
    u_nodes, v_nodes = np.meshgrid(u, v, indexing="ij")
    points: Floats = surface.evaluate(u_nodes.ravel(), v_nodes.ravel())[:, 0]
    return points.reshape(len(u), len(v), 3)


def width_mm(
    tool: _core.Tool,
    tip: Floats,
    axis: Floats,
    contact: Floats,
    ground: Ground,
    along: Floats,
    scallop_mm: float,
) -> float:
    """Width, across the feed direction `along`, of the strip round `contact` (3,) in which the tool at tip, axis is no
    farther than scallop_mm from the ground; NaN without a contact. To about STEP_PER_RADIUS of the cutter's radius.
    """
    if not np.isfinite(contact).all():
        return float("nan")
    across = np.cross(along, [0.0, 0.0, 1.0])
    gap = tool.signed_distance(tip, axis, ground.points)
    bin_mm = 2 * STEP_PER_RADIUS * tool.radius
    bins = np.floor((ground.points - contact) @ across / bin_mm + 0.5).astype(int)
    offset = bins.min()
    least = np.full(bins.max() - offset + 1, np.inf)
    np.minimum.at(least, bins - offset, gap)
    inside = least <= scallop_mm
    first = last = -offset
    while first > 0 and inside[first - 1]:
        first -= 1
    while last + 1 < len(inside) and inside[last + 1]:
        last += 1
    return float((last - first + 1) * bin_mm)
