"""Sections of the machined surface, and what a probe would measure of them."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from .plane_curve import Curve, Plane, curve

if TYPE_CHECKING:
    from .cutting import Cut

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

# Sections beside the one that is probed, a probe's radius to either side.
PROBE_LINES = 16
HEADER = (
    "s_mm", "way_mm", "piece", "x", "y", "z", "machined_x", "machined_y", "machined_z", "deviation_mm", "move",
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Section:
    """The machined surface along the curves in which a plane meets the faces to machine; part frame, mm.

    The points are in the order of the curve, piece by piece (`plane_curve.Curve`)."""

    plane: Plane
    piece: Integers  # (N,)
    points: Floats  # (N, 3), on the true surface
    normals: Floats  # (N, 3), of the true surface
    deviation_mm: Floats  # (N,), along those normals
    move: Integers  # (N,), row of the path that cut there last

    @property
    def s_mm(self) -> Floats:
        """(N,): along `plane.along`, from the plane's origin."""
        return np.asarray((self.points - self.plane.origin) @ self.plane.along)

    @property
    def way_mm(self) -> Floats:
        """(N,): along the curve, from the first point on; what lies between two pieces does not count."""
        steps = np.linalg.norm(np.diff(self.points, axis=0, prepend=self.points[:1]), axis=1)
        return np.asarray(np.cumsum(np.where(np.diff(self.piece, prepend=self.piece[:1]) == 0, steps, 0.0)))

    @property
    def machined(self) -> Floats:
        """(N, 3): points of the machined surface; off the plane as far as the normals lead there."""
        return np.asarray(self.points + self.deviation_mm[:, None] * self.normals)

    def to_csv(self) -> str:
        """One line a point."""
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(HEADER)
        places = np.column_stack((self.points, self.machined, self.deviation_mm)).tolist()
        for s, way, piece, row, move in zip(self.s_mm, self.way_mm, self.piece, places, self.move.tolist()):
            writer.writerow([f"{s:.6f}", f"{way:.6f}", piece, *(f"{value:.6f}" for value in row), move])
        return text.getvalue()


def measured(cut: Cut, of: Curve) -> Section:
    """What the cut left along a curve."""
    deviation, move = cut.heights(of.points, of.normals)
    return Section(of.plane, of.piece, of.points, of.normals, deviation, move)


def probed(cut: Cut, of: Section, radius_mm: float) -> Floats:
    """(N,) mm: the deviation that a measuring machine finds at the points of a section, whose ball of `radius_mm` comes
    down along the normal of the true surface and touches the machined one; the ball's radius is taken off. It rests
    on the highest places within its reach, so narrow grooves come out too high and gouges too shallow.
    """
    spacing = max(2 * radius_mm / PROBE_LINES, 0.0)
    offsets = spacing * np.arange(-PROBE_LINES / 2, PROBE_LINES / 2 + 1)
    cloud = [_touched(cut, of, offset, spacing / 2) for offset in offsets]
    points = np.concatenate([one for one in cloud if len(one)])
    way = (points - of.plane.origin) @ of.plane.along
    order = np.argsort(way)
    return _resting(of, points[order], way[order], radius_mm)


def _touched(cut: Cut, of: Section, offset: float, spacing: float) -> Floats:
    """Points (K, 3) of the machined surface in the plane beside a section; none where that misses the part."""
    origin, normal = of.plane.origin, of.plane.normal
    try:
        beside = curve(cut.scene, (origin + offset * normal).tolist(), normal.tolist(), spacing)
    except ValueError:
        return np.zeros((0, 3))
    return measured(cut, beside).machined


def _resting(of: Section, points: Floats, way: Floats, radius_mm: float) -> Floats:
    result = np.full(len(of.points), np.nan)
    s = of.s_mm
    # The ball's centre leaves the plane's line by the normal's lean.
    first, last = np.searchsorted(way, s - radius_mm), np.searchsorted(way, s + radius_mm)
    for i, (point, normal) in enumerate(zip(of.points, of.normals)):
        near = points[first[i] : last[i]] - point
        height = near @ normal
        square = radius_mm**2 - (np.einsum("ij,ij->i", near, near) - height**2)
        reached = square >= 0
        if reached.any():
            result[i] = (height[reached] + np.sqrt(square[reached])).max() - radius_mm
    return result
