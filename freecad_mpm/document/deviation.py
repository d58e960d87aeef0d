"""The deviation that a verification keeps in its document: as stored, read back, and looked for on a line of sight."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.base import Floats, Integers

if TYPE_CHECKING:  # needs the native module
    from ..core.removal import Cut


@dataclass(frozen=True)
class Deviation:
    """The deviation that a result holds; global frame, mm. Single precision, as it is for looking at."""

    points: Floats  # (N, 3), on the faces to machine; then those of the other faces that are cut, and round them
    deviation_mm: Floats  # (N,), along the normal: > 0 remains, < 0 is cut in; of other faces how deep in the tool
    move: Integers  # (N,), move of the path that cut there last, -1: none; of other faces the one that went deepest
    triangles: Integers  # (T, 3) of points
    measured: int  # points of the faces to machine

    def nearest(self, point: Any) -> int:
        """The row nearest to a point (3,)."""
        return int(np.argmin(((self.points - np.asarray(tuple(point))) ** 2).sum(axis=1)))

    def first_on_line(self, start: Any, end: Any, reach_mm: float) -> int | None:
        """The row that the way from `start` to `end` (3,) meets first, passing it within `reach_mm`; None: it misses."""
        start, end = np.asarray(tuple(start)), np.asarray(tuple(end))
        direction = (end - start) / np.linalg.norm(end - start)
        offset = self.points - start
        along = offset @ direction
        beside = np.linalg.norm(offset - np.outer(along, direction), axis=1)
        rows = np.flatnonzero((beside <= reach_mm) & (along >= 0))
        if not len(rows):
            return None
        first = rows[along[rows] <= along[rows].min() + 2 * reach_mm]  # one spot of the face
        return int(first[np.argmin(beside[first])])


def store(result: Any, cut: Cut) -> None:
    """Put the deviation of the faces to machine, and what is cut of the others, into the result's property Data.

    FreeCAD copies the file into the document."""
    found, aside = cut.deviation, cut.overcut
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "deviation.npz"
        np.savez_compressed(
            file,
            points=np.concatenate((found.points, aside.points)).astype(np.float32),
            deviation_mm=np.concatenate((found.deviation_mm, -aside.depth_mm)).astype(np.float32),
            move=np.concatenate((found.move, aside.move)).astype(np.int32),
            triangles=np.concatenate((found.triangles, aside.triangles + len(found.points))).astype(
                np.uint32
            ),
            measured=len(found.points),
        )
        result.Data = str(file)


def deviation_of(result: Any) -> Deviation:
    """What `store` put into the result, and the 3D view colours."""
    with np.load(result.Data) as data:
        points = data["points"]
        measured = int(data["measured"]) if "measured" in data else len(points)  # not in the first documents
        return Deviation(points, data["deviation_mm"], data["move"], data["triangles"], measured)
