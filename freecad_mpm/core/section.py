"""Sections of the machined surface, and what a probe would measure of them."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .. import _core
from .faces import FaceArrays

if TYPE_CHECKING:
    from .cutting import Cut

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Newton steps that carry a point of the surface onto the plane; they start a triangle's sag away from it.
NEWTON_STEPS = 4
# Sections beside the one that is probed, a probe's radius to either side.
PROBE_LINES = 16
HEADER = ("s_mm", "x", "y", "z", "machined_x", "machined_y", "machined_z", "deviation_mm", "move")


@dataclass(frozen=True, eq=False)
class Section:
    """The machined surface along the curves in which a plane cuts the faces to machine; part frame, mm.

    Points are in order of `s_mm`, the way along `direction` (unit, in the plane, across the set-up's z) from `origin`.
    """

    origin: Floats
    normal: Floats
    direction: Floats
    s_mm: Floats  # (N,)
    points: Floats  # (N, 3), on the true surface
    normals: Floats  # (N, 3), of the true surface
    deviation_mm: Floats  # (N,), along those normals
    move: Integers  # (N,), row of the path that cut there last

    @property
    def machined(self) -> Floats:
        """(N, 3): points of the machined surface; off the plane as far as the normals lead there."""
        return np.asarray(self.points + self.deviation_mm[:, None] * self.normals)

    def to_csv(self) -> str:
        """One line a point."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(HEADER)
        table = np.column_stack((self.s_mm, self.points, self.machined, self.deviation_mm))
        for row, move in zip(table.tolist(), self.move.tolist()):
            writer.writerow([*(f"{value:.6f}" for value in row), move])
        return text.getvalue()


def section(cut: Cut, origin: Sequence[float], normal: Sequence[float], spacing_mm: float) -> Section:
    """The section of `cut` by the plane through `origin` square to `normal` (part frame), points at most `spacing_mm`
    apart along the surface. Raises ValueError when the plane misses the faces or is square to the set-up's z.
    """
    frame = _plane_frame(cut, origin, normal)
    points, normals = _curve(cut, frame, spacing_mm)
    deviation, move = cut.heights(points, normals)
    s = (points - frame.origin) @ frame.direction
    return Section(frame.origin, frame.normal, frame.direction, s, points, normals, deviation, move)


def probed(cut: Cut, of: Section, radius_mm: float) -> Floats:
    """(N,) mm: the deviation that a measuring machine finds at the points of a section, whose ball of `radius_mm` comes
    down along the normal of the true surface and touches the machined one; the ball's radius is taken off. It rests
    on the highest places within its reach, so narrow grooves come out too high and gouges too shallow.
    """
    spacing = max(2 * radius_mm / PROBE_LINES, 0.0)
    offsets = spacing * np.arange(-PROBE_LINES / 2, PROBE_LINES / 2 + 1)
    cloud = [_touched(cut, of, offset, spacing / 2) for offset in offsets]
    points = np.concatenate([one for one in cloud if len(one)])
    way = (points - of.origin) @ of.direction
    order = np.argsort(way)
    return _resting(of, points[order], way[order], radius_mm)


def _touched(cut: Cut, of: Section, offset: float, spacing: float) -> Floats:
    """Points (K, 3) of the machined surface in the plane beside a section; none where that misses the part."""
    try:
        return section(cut, (of.origin + offset * of.normal).tolist(), of.normal.tolist(), spacing).machined
    except ValueError:
        return np.zeros((0, 3))


def _resting(of: Section, points: Floats, way: Floats, radius_mm: float) -> Floats:
    result = np.full(len(of.points), np.nan)
    # The ball's centre leaves the plane's line by the normal's lean.
    first, last = np.searchsorted(way, of.s_mm - radius_mm), np.searchsorted(way, of.s_mm + radius_mm)
    for i, (point, normal) in enumerate(zip(of.points, of.normals)):
        near = points[first[i] : last[i]] - point
        height = near @ normal
        square = radius_mm**2 - (np.einsum("ij,ij->i", near, near) - height**2)
        reached = square >= 0
        if reached.any():
            result[i] = (height[reached] + np.sqrt(square[reached])).max() - radius_mm
    return result


@dataclass(frozen=True)
class _Plane:
    origin: Floats
    normal: Floats
    direction: Floats


def _plane_frame(cut: Cut, origin: Sequence[float], normal: Sequence[float]) -> _Plane:
    at, across = np.array(origin, dtype=np.float64), np.array(normal, dtype=np.float64)
    along = np.cross(across, cut.scene.frame.axes[:, 2])
    if at.shape != (3,) or across.shape != (3,) or not np.linalg.norm(along) > 0:
        raise ValueError("normal must be three numbers and not along the set-up's z")
    return _Plane(at, across / np.linalg.norm(across), along / np.linalg.norm(along))


def _curve(cut: Cut, plane: _Plane, spacing_mm: float) -> tuple[Floats, Floats]:
    """Points and normals (N, 3) on the faces and in the plane, in order along it."""
    if not (np.isfinite(spacing_mm) and spacing_mm > 0):
        raise ValueError(f"spacing_mm must be a positive number, got {spacing_mm}")
    points, normals = [], []
    for index, face in enumerate(cut.scene.machined):
        at = _crossings(cut, plane, index, spacing_mm)
        on_plane, normal = _onto_plane(face, at, plane)
        up = np.sign(normal @ cut.scene.frame.axes[:, 2])
        points.append(on_plane)
        normals.append(normal * np.where(up == 0, 1.0, up)[:, None])
    all_points, all_normals = np.concatenate(points), np.concatenate(normals)
    if not len(all_points):
        raise ValueError("the plane does not meet the faces to machine")
    order = np.argsort(all_points @ plane.direction, kind="stable")
    return all_points[order], all_normals[order]


def _crossings(cut: Cut, plane: _Plane, face: int, spacing_mm: float) -> Floats:
    """(K, 2): parameters near which the plane meets a face, from the triangles of the deviation."""
    found = cut.deviation
    corners = found.triangles[found.face[found.triangles[:, 0]] == face]
    side = ((found.points - plane.origin) @ plane.normal)[corners]
    crossed = (side >= 0).any(axis=1) & (side < 0).any(axis=1)
    corners, side = corners[crossed], side[crossed]
    if not len(corners):
        return np.zeros((0, 2))
    # The corner that lies alone on its side; the plane leaves the triangle through its two edges.
    alone = np.where((side >= 0).sum(axis=1) == 1, np.argmax(side >= 0, axis=1), np.argmax(side < 0, axis=1))
    rows = np.arange(len(corners))
    ends = [_on_edge(found, corners, side, rows, alone, (alone + k) % 3) for k in (1, 2)]
    steps = max(1, int(np.ceil(np.linalg.norm(ends[1][1] - ends[0][1], axis=1).max() / spacing_mm)))
    share = np.linspace(0.0, 1.0, steps + 1)[:, None, None]
    between = (1 - share) * ends[0][0] + share * ends[1][0]
    return np.unique(np.round(between.reshape(-1, 2), 12), axis=0)


def _on_edge(
    found: Any, corners: Any, side: Floats, rows: Integers, a: Integers, b: Integers
) -> tuple[Floats, Floats]:
    """Parameters and points where the edges from corners a to b cross the plane."""
    share = (side[rows, a] / (side[rows, a] - side[rows, b]))[:, None]
    i, j = corners[rows, a], corners[rows, b]
    return (
        (1 - share) * found.at[i] + share * found.at[j],
        (1 - share) * found.points[i] + share * found.points[j],
    )


def _onto_plane(face: FaceArrays, at: Floats, plane: _Plane) -> tuple[Floats, Floats]:
    """The points of the surface near parameters `at` (K, 2) that lie in the plane, and the normals there."""
    surface = _core.BSplineSurface(
        face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights
    )
    u0, u1, v0, v1 = surface.domain
    for _ in range(NEWTON_STEPS):
        jet = surface.evaluate(at[:, 0].copy(), at[:, 1].copy())
        miss = (jet[:, 0] - plane.origin) @ plane.normal
        slope = jet[:, 1:3] @ plane.normal
        size = np.einsum("ij,ij->i", slope, slope)
        step = np.divide(miss, size, out=np.zeros_like(miss), where=size > 0)
        at = np.clip(at - step[:, None] * slope, (u0, v0), (u1, v1))
    jet = surface.evaluate(at[:, 0].copy(), at[:, 1].copy())
    normal = np.cross(jet[:, 1], jet[:, 2])
    length = np.linalg.norm(normal, axis=1)
    kept = length > 0
    return jet[kept, 0], normal[kept] / length[kept, None]
