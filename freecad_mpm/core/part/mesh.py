"""Faces as quadrilaterals, for pictures."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.path import Path as Polygon

from ... import _core
from ..base import Flags, Floats
from .faces import FaceArrays

# Quadrilaterals along each side of a face.
LEAST_DIVISIONS = 4
MOST_DIVISIONS = 60


def quads(faces: Sequence[FaceArrays], budget: int) -> list[Floats]:
    """For each face its quadrilaterals (Q, 4 corners, 3), part frame, mm; about `budget` of them in all.

    Those whose middle the trimming loops leave out are left out."""
    divisions = int(np.clip((budget / max(len(faces), 1)) ** 0.5, LEAST_DIVISIONS, MOST_DIVISIONS))
    return [_face_quads(face, divisions) for face in faces]


def _face_quads(face: FaceArrays, divisions: int) -> Floats:
    surface = _core.BSplineSurface(
        face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights
    )
    u0, u1, v0, v1 = surface.domain
    u, v = np.linspace(u0, u1, divisions + 1), np.linspace(v0, v1, divisions + 1)
    u_nodes, v_nodes = np.meshgrid(u, v, indexing="ij")
    points = surface.evaluate(u_nodes.ravel(), v_nodes.ravel())[:, 0].reshape(divisions + 1, divisions + 1, 3)
    corners = [points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]]
    middles = np.stack(np.meshgrid((u[:-1] + u[1:]) / 2, (v[:-1] + v[1:]) / 2, indexing="ij"), axis=-1)
    all_quads: Floats = np.stack(corners, axis=2).reshape(-1, 4, 3)
    return all_quads[_inside(face, middles.reshape(-1, 2))]


def _inside(face: FaceArrays, at: Floats) -> Flags:
    """Even-odd rule over the trimming loops."""
    if not len(face.trim_loops):
        return np.ones(len(at), dtype=bool)
    inside = np.zeros(len(at), dtype=bool)
    for loop in face.trim_loops:
        inside ^= Polygon(loop).contains_points(at)
    return inside
