"""Sections of the machined surface, and what a probe would measure of them."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass

import numpy as np

from ..base import Floats, Integers
from .plane_curve import Plane

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
