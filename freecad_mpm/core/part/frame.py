"""The set-up frame: from the part's coordinates to those the tool is placed in, and back."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base import Floats
from ..job import Setup


@dataclass(frozen=True)
class Frame:
    """A right-handed orthonormal frame in the part's: `origin` (3,) mm, `axes` (3, 3) with x, y and z as columns.

    All functions take and return arrays (..., 3); NaN stays NaN."""

    origin: Floats
    axes: Floats

    def to_setup(self, points: Floats) -> Floats:
        """Points (..., 3), mm: shifted, then turned."""
        return self.direction_to_setup(points - self.origin)

    def to_part(self, points: Floats) -> Floats:
        """Points (..., 3), mm: the inverse of `to_setup`, up to rounding."""
        return self.direction_to_part(points) + self.origin

    def direction_to_setup(self, directions: Floats) -> Floats:
        """Directions (..., 3) are turned only; they keep their length."""
        return self._turned(directions, self.axes)

    def direction_to_part(self, directions: Floats) -> Floats:
        """Directions (..., 3) are turned back only; they keep their length."""
        return self._turned(directions, self.axes.T)

    def _turned(self, directions: Floats, matrix: Floats) -> Floats:
        # Most set-ups are not turned, and millions of products of three by three take their time.
        return directions.copy() if (matrix == np.eye(3)).all() else directions @ matrix


def frame_of(setup: Setup) -> Frame:
    """x is turned into the plane across z; the job has checked that the two are not parallel."""
    z = np.array(setup.z) / np.linalg.norm(setup.z)
    x = np.array(setup.x) - np.dot(setup.x, z) * z
    x /= np.linalg.norm(x)
    return Frame(np.array(setup.origin), np.column_stack((x, np.cross(z, x), z)))
