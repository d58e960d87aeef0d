"""Where a plane meets the faces to machine: curves of points on the true surface, known before anything is cut."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ... import _core
from ..base import Floats, Integers
from ..part import FaceArrays, Frame, Scene

# The plane is followed over triangles so small that this many lie along the faces.
TRIANGLES_ALONG = 500
# Newton steps that carry a point of the surface onto the plane; they start a triangle's sag away from it.
NEWTON_STEPS = 4
COINCIDENT_MM = 1e-9
# A plane is level when its normal is so near to the set-up's z (sine of the angle).
LEVEL = 1e-9


class Plane(NamedTuple):
    """A plane with two directions in it, `along` and `up`; part frame, all unit."""

    origin: Floats
    normal: Floats
    along: Floats  # across the set-up's z; in a level plane the set-up's x
    up: Floats  # square to `along`


@dataclass(frozen=True, eq=False)
class Curve:
    """Points of the true surface in a plane, in pieces; part frame, mm. Along a piece the points are in order, from the
    end that lies first along `plane.along`; the pieces are in the order of their first points."""

    plane: Plane
    points: Floats  # (N, 3)
    normals: Floats  # (N, 3), of the surface, on the side of the set-up's z
    piece: Integers  # (N,), from 0


def plane_of(frame: Frame, origin: Sequence[float], normal: Sequence[float]) -> Plane:
    """The plane through `origin` square to `normal`, of any length but 0. Raises ValueError naming what is wrong."""
    at, across = np.array(origin, dtype=np.float64), np.array(normal, dtype=np.float64)
    if at.shape != (3,) or across.shape != (3,) or not (np.isfinite(at).all() and np.isfinite(across).all()):
        raise ValueError("origin and normal must be three finite numbers each")
    if not np.linalg.norm(across) > 0:
        raise ValueError("normal must not be zero")
    across /= np.linalg.norm(across)
    along = np.cross(across, frame.axes[:, 2])
    if np.linalg.norm(along) < LEVEL:
        return Plane(at, across, frame.axes[:, 0], frame.axes[:, 1])
    along /= np.linalg.norm(along)
    return Plane(at, across, along, np.cross(along, across))


def curve(scene: Scene, origin: Sequence[float], normal: Sequence[float], spacing_mm: float) -> Curve:
    """The curves in which the plane meets the faces to machine, points at most `spacing_mm` apart along them. Where the
    plane touches a face without crossing it, nothing is found.

    Raises ValueError when the plane misses the faces, or for an argument out of range."""
    if not (np.isfinite(spacing_mm) and spacing_mm > 0):
        raise ValueError(f"spacing_mm must be a positive number, got {spacing_mm}")
    plane = plane_of(scene.frame, origin, normal)
    samples = _samples(scene)
    pieces = [
        _carried(scene, face, chain, plane, spacing_mm)
        for index, face in enumerate(scene.machined)
        for chain in _chains(samples, index, plane)
    ]
    pieces = sorted((one for one in pieces if len(one[0])), key=lambda one: float(one[0][0] @ plane.along))
    if not pieces:
        raise ValueError("the plane does not meet the faces to machine")
    piece = np.repeat(np.arange(len(pieces)), [len(points) for points, _ in pieces])
    return Curve(
        plane, np.concatenate([one[0] for one in pieces]), np.concatenate([one[1] for one in pieces]), piece
    )


class _Samples(NamedTuple):
    points: Floats  # (N, 3), part frame
    at: Floats  # (N, 2), parameters
    face: Integers  # (N,)
    triangles: Integers  # (T, 3)


def _samples(scene: Scene) -> _Samples:
    lo, hi = scene.model.machined_bounds()
    spacing = float((hi - lo).max()) / TRIANGLES_ALONG
    found = _core.sample_surfaces(scene.model, spacing_mm=spacing, lo=lo, hi=hi, context=_core.Context())
    return _Samples(
        scene.frame.to_part(found["points"]),
        found["at"],
        found["face"].astype(np.int64),
        found["triangles"].astype(np.int64),
    )


def _chains(samples: _Samples, face: int, plane: Plane) -> Iterator[tuple[Floats, Floats]]:
    """Where the plane crosses the edges of a face's triangles, from edge to edge: parameters (K, 2) and points (K, 3) of
    each chain. A closed one ends where it begins."""
    corners = samples.triangles[samples.face[samples.triangles[:, 0]] == face]
    height = (samples.points - plane.origin) @ plane.normal
    above = height[corners] >= 0
    crossed = above.any(axis=1) & ~above.all(axis=1)
    corners, above = corners[crossed], above[crossed]
    # The corner alone on its side; the plane leaves the triangle through the two edges that end there.
    alone = np.where(above.sum(axis=1) == 1, np.argmax(above, axis=1), np.argmin(above, axis=1))
    rows = np.arange(len(corners))
    edges = np.stack(
        [corners[rows[:, None], np.column_stack((alone, (alone + k) % 3))] for k in (1, 2)], axis=1
    )
    nodes, node = np.unique(np.sort(edges, axis=2).reshape(-1, 2), axis=0, return_inverse=True)
    share = (height[nodes[:, 0]] / (height[nodes[:, 0]] - height[nodes[:, 1]]))[:, None]
    at, points = (
        (1 - share) * values[nodes[:, 0]] + share * values[nodes[:, 1]]
        for values in (samples.at, samples.points)
    )
    for chain in _walks(node.reshape(-1, 2), len(nodes)):
        ends = points[chain[[0, -1]]] @ plane.along
        ordered = chain if ends[0] <= ends[1] else chain[::-1]
        apart = np.linalg.norm(np.diff(points[ordered], axis=0), axis=1) > COINCIDENT_MM
        ordered = ordered[np.append(True, apart)]  # a corner in the plane is crossed with several edges
        yield at[ordered], points[ordered]


def _walks(links: Integers, count: int) -> Iterator[Integers]:
    """Chains of nodes, each linked to the next; of no node more than two links. Open ones first."""
    beside: list[list[int]] = [[] for _ in range(count)]
    for a, b in links.tolist():
        beside[a].append(b)
        beside[b].append(a)
    seen = np.zeros(count, dtype=bool)
    starts = [i for i in range(count) if len(beside[i]) == 1] + list(range(count))
    for start in starts:
        if seen[start]:
            continue
        chain = [start]
        seen[start] = True
        while ahead := [i for i in beside[chain[-1]] if not seen[i]]:
            chain.append(ahead[0])
            seen[ahead[0]] = True
        if len(chain) > 2 and start in beside[chain[-1]]:
            chain.append(start)
        yield np.array(chain)


def _carried(
    scene: Scene, face: FaceArrays, chain: tuple[Floats, Floats], plane: Plane, spacing_mm: float
) -> tuple[Floats, Floats]:
    """Points and normals (N, 3) of the face along a chain, in the plane."""
    at, points = chain
    steps = np.maximum(1, np.ceil(np.linalg.norm(np.diff(points, axis=0), axis=1) / spacing_mm).astype(int))
    first = np.repeat(np.arange(len(steps)), steps)
    share = (np.arange(len(first)) - np.repeat(np.cumsum(steps) - steps, steps)) / np.repeat(steps, steps)
    between = at[first] + share[:, None] * (at[first + 1] - at[first]) if len(first) else at[:0]
    on_plane, normals = _onto_plane(face, np.concatenate((between, at[-1:])), plane)
    up = np.sign(normals @ scene.frame.axes[:, 2])
    return on_plane, normals * np.where(up == 0, 1.0, up)[:, None]


def _onto_plane(face: FaceArrays, at: Floats, plane: Plane) -> tuple[Floats, Floats]:
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
