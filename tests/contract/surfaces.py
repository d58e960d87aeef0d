"""Surfaces for the contract of the methods, and the rewritings that leave a surface what it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import comb

import numpy as np

from freecad_mpm import _core
from tests.conftest import thesis_poles


@dataclass(frozen=True)
class Case:
    """Control points (n, m, 3) of one face with its knots, the tool's radii and footprint points, all mm."""

    poles: np.ndarray
    points: np.ndarray
    knots_u: np.ndarray
    knots_v: np.ndarray
    degrees: tuple[int, int]
    scale: float = 1.0

    def tool(self) -> _core.Tool:
        return _core.Tool(6.7 * self.scale, 6.0 * self.scale, 6.0 * self.scale, 40.0 * self.scale)

    def model(self) -> _core.SurfaceModel:
        surface = _core.BSplineSurface(*self.degrees, self.knots_u, self.knots_v, self.poles)
        return _core.SurfaceModel([_core.Face("Face1", surface)])


def bezier(poles: np.ndarray, points: np.ndarray) -> Case:
    degrees = (len(poles) - 1, poles.shape[1] - 1)
    knots = [np.repeat([0.0, 1.0], degree + 1) for degree in degrees]
    return Case(poles, points, knots[0], knots[1], degrees)


# Off every line of symmetry of the thesis' surfaces, where two contacts may tie, and away from the borders.
POINTS = np.array([(37, 52), (53, 90), (71, 41), (91, 109), (107, 62), (64, 117)], float)


def plane(slope: float) -> Case:
    x, y = np.meshgrid([0.0, 150.0], [0.0, 150.0], indexing="ij")
    return bezier(np.dstack((x, y, slope * x)), POINTS)


def bowl() -> Case:
    """A paraboloid, degree 2, osculating a sphere of 100 mm at its bottom."""
    t = np.array([-75.0, 0.0, 75.0])
    x, y = np.meshgrid(t + 75, t + 75, indexing="ij")
    z = np.array([75.0**2, -(75.0**2), 75.0**2]) / 200
    return bezier(np.dstack((x, y, z[:, None] + z[None, :])), POINTS)


CASES: dict[str, Case] = {
    **{name: bezier(thesis_poles(name), POINTS) for name in ("convex", "concave", "saddle")},
    "plane": plane(0.2),
    "bowl": bowl(),
}


def moved(case: Case) -> Case:
    offset = np.array([123.25, -51.5, 17.0])
    return replace(case, poles=case.poles + offset, points=case.points + offset[:2])


def swapped(case: Case) -> Case:
    return bezier(np.ascontiguousarray(case.poles.transpose(1, 0, 2)), case.points)


def turned_round(case: Case) -> Case:
    return bezier(np.ascontiguousarray(case.poles[::-1]), case.points)


def elevated(case: Case) -> Case:
    """One degree more in u."""
    n = len(case.poles)
    share = (np.arange(1, n) / n)[:, None, None]
    inner = share * case.poles[:-1] + (1 - share) * case.poles[1:]
    return bezier(np.concatenate((case.poles[:1], inner, case.poles[-1:])), case.points)


def split(case: Case) -> Case:
    """A knot of full multiplicity at u = 1/2."""
    n = len(case.poles)
    left = [sum(comb(i, k) * case.poles[k] for k in range(i + 1)) / 2**i for i in range(n)]
    right = [
        sum(comb(n - 1 - i, k) * case.poles[i + k] for k in range(n - i)) / 2 ** (n - 1 - i) for i in range(n)
    ]
    knots = np.concatenate((np.zeros(n), np.full(n - 1, 0.5), np.ones(n)))
    return replace(case, poles=np.array(left + right[1:]), knots_u=knots)


def scaled(case: Case) -> Case:
    return replace(case, poles=case.poles / 2, points=case.points / 2, scale=case.scale / 2)


REWRITINGS: dict[str, Callable[[Case], Case]] = {
    "translation": moved,
    "u and v exchanged": swapped,
    "u reversed": turned_round,
    "degree elevated": elevated,
    "knot inserted": split,
    "scaled": scaled,
}
