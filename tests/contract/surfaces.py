"""Surfaces for the contract of the methods, and the rewritings that leave a surface what it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import comb, cos, radians, sin

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
    weights: np.ndarray | None = None
    trim_loops: tuple[np.ndarray, ...] = ()
    others: tuple[_core.Face, ...] = ()

    def tool(self) -> _core.Tool:
        return _core.Tool(6.7 * self.scale, 6.0 * self.scale, 6.0 * self.scale, 40.0 * self.scale)

    def model(self) -> _core.SurfaceModel:
        surface = _core.BSplineSurface(*self.degrees, self.knots_u, self.knots_v, self.poles, self.weights)
        face = _core.Face("Face1", surface, list(self.trim_loops))
        return _core.SurfaceModel([face, *self.others])


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


def mirrored(case: Case) -> Case:
    """In the plane x = 75 mm."""
    over = np.array([-1.0, 1.0, 1.0])
    shift = np.array([150.0, 0.0, 0.0])
    return replace(case, poles=case.poles * over + shift, points=case.points * over[:2] + shift[:2])


def turned_about_z(case: Case) -> Case:
    """The part turned by 37 degrees about the set-up's axis."""
    c, s = cos(radians(37.0)), sin(radians(37.0))  # numpy's own differ in the last digit by processor
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return replace(case, poles=case.poles @ turn.T, points=case.points @ turn[:2, :2].T)


def trimmed(case: Case) -> Case:
    """A strip along the border cut off that no tool over the points comes near: nothing changes under it."""
    u0, u1, v0, v1 = case.knots_u[0], case.knots_u[-1], case.knots_v[0], case.knots_v[-1]
    lo_u, hi_u = u0 + 0.03 * (u1 - u0), u1 - 0.03 * (u1 - u0)
    lo_v, hi_v = v0 + 0.03 * (v1 - v0), v1 - 0.03 * (v1 - v0)
    loop = np.array([[lo_u, lo_v], [hi_u, lo_v], [hi_u, hi_v], [lo_u, hi_v]])
    return replace(case, trim_loops=(loop,))


def beside_a_check_face(case: Case) -> Case:
    """A wall to keep clear of, beyond the reach of every tool over the points."""
    beside = case.poles[..., 0].max() + 5.0
    y = np.array([case.poles[..., 1].min(), case.poles[..., 1].max()])
    top = case.poles[..., 2].max() + 50.0
    wall = np.array([[[beside, one, height] for height in (0.0, top)] for one in y])
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    face = _core.Face("Wall", _core.BSplineSurface(1, 1, knots, knots, wall), check=True)
    return replace(case, others=(face,))


REWRITINGS: dict[str, Callable[[Case], Case]] = {
    "translation": moved,
    "u and v exchanged": swapped,
    "u reversed": turned_round,
    "degree elevated": elevated,
    "knot inserted": split,
    "scaled": scaled,
    "mirrored": mirrored,
    "turned about z": turned_about_z,
    "trimmed far away": trimmed,
    "a check face far away": beside_a_check_face,
}


# Rational quadratic arcs: weights of an arc of 90 degrees are 1, cos 45 degrees, 1.
ARC_WEIGHTS = np.array([1.0, np.sqrt(0.5), 1.0])
ROUND_POINTS = np.array([(-9.0, 14.0), (6.0, -11.0), (17.0, 4.0), (-15.0, -16.0)])


def arc(radius: float) -> np.ndarray:
    """Control points (3, 2) of the arc of 90 degrees about the second coordinate: (across, along)."""
    half = radius * np.sqrt(0.5)
    return np.array([(-half, half), (0.0, 2 * half), (half, half)])


def revolved(profile: np.ndarray, weights: np.ndarray, degree: int, side: float) -> Case:
    """A profile of (radius, y) turned by 90 degrees about the y axis; side +1: seen from outside, -1: from inside."""
    turn = arc(1.0)
    radius, y = profile[:, None, 0], profile[:, None, 1]
    across, up = radius * turn[None, :, 0], radius * turn[None, :, 1]
    poles = np.dstack((across, np.broadcast_to(y, across.shape), side * up))
    knots_u, knots_v = np.repeat([0.0, 1.0], degree + 1), np.repeat([0.0, 1.0], 3)
    return Case(
        np.ascontiguousarray(poles),
        ROUND_POINTS,
        knots_u,
        knots_v,
        (degree, 2),
        weights=weights[:, None] * ARC_WEIGHTS[None, :],
    )


def cylinder(radius: float, side: float) -> Case:
    """About the y axis."""
    return revolved(np.array([(radius, -80.0), (radius, 80.0)]), np.ones(2), 1, side)


def sphere(radius: float, side: float) -> Case:
    """About the origin."""
    return revolved(arc(radius)[:, ::-1], ARC_WEIGHTS, 2, side)


def torus(core: float, tube: float, side: float) -> Case:
    """A tube about the circle of radius `core` round the y axis, the side away from that axis; seen from outside it is a
    ring (side +1), from inside a bowl."""
    return revolved(arc(tube)[:, ::-1] + [core, 0.0], ARC_WEIGHTS, 2, side)
