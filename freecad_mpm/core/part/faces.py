"""Faces as plain arrays: what every source of a part gives, and what the native core is made from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from ... import _core
from ..base import Floats, InputError


class SetupFrame(Protocol):
    """What can carry points (..., 3) from the part frame into a set-up frame (core.part.Frame)."""

    def to_setup(self, points: Floats) -> Floats:
        """Points (..., 3), mm, of the part frame; NaN stays NaN."""


@dataclass(frozen=True, eq=False)
class FaceArrays:
    """One face: a B-spline surface of degree 1 to 10 and the part of its parameter plane that belongs to it.

    `poles` (nu, nv, 3) are in mm in the part frame, placement applied; `weights` (nu, nv) are positive, None
    for a polynomial surface. `knots_u` (nu + degree_u + 1,) and `knots_v` have their multiplicities written
    out and need not be clamped. `trim_loops` are closed polygons (N, 2) in (u, v) under the even-odd rule,
    the last point not repeated; without one the whole rectangle of parameters belongs to the face. `kind`
    says what the surface was in its file ("plane", "cylinder", "bspline", ...), and `deviation_mm` how far it
    may be from that (0: exact). `reversed`: the material lies on the side of Su x Sv."""

    name: str
    kind: str
    degree_u: int
    degree_v: int
    knots_u: Floats
    knots_v: Floats
    poles: Floats
    weights: Floats | None = None
    trim_loops: Sequence[Floats] = ()
    reversed: bool = False
    deviation_mm: float = 0.0

    @property
    def rational(self) -> bool:
        """Its poles have weights; without them all count as 1."""
        return self.weights is not None

    @property
    def trimmed(self) -> bool:
        """It has trim loops; without them the whole parameter rectangle belongs to it."""
        return len(self.trim_loops) > 0

    def transformed(self, frame: SetupFrame) -> FaceArrays:
        """The same face with its poles in the coordinates of `frame`."""
        return replace(self, poles=frame.to_setup(self.poles))


def to_core(face: FaceArrays, check: bool = False) -> _core.Face:
    """The native face; `check`: to be kept clear of, not machined.

    Raises InputError naming the face when its arrays do not fit together."""
    try:
        surface = _core.BSplineSurface(
            face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights
        )
        return _core.Face(face.name, surface, list(face.trim_loops), check)
    except ValueError as error:
        raise InputError(f"{face.name}: {error}") from None
