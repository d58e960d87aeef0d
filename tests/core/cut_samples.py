"""Planes, and paths of a ball over them, to be cut."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from freecad_mpm.core.job import Job, Part, ToolSpec
from freecad_mpm.core.part import FaceArrays, Scene, build_scene

BALL_MM = 5.0
# More stock than the faces' own box, which ends on them.
BOX = ([0.0, 0.0, -45.0], [40.0, 40.0, 45.0])
UP = np.array([0.0, 0.0, 1.0])


def plane(slope: float, size: float = 40.0) -> FaceArrays:
    """A square plane that rises along x."""
    poles = np.array([[[x, y, slope * x] for y in (0.0, size)] for x in (0.0, size)])
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    return FaceArrays("Face1", "plane", 1, 1, knots, knots, poles)


def scene_of(face: FaceArrays, tool: ToolSpec | None = None) -> Scene:
    tool = tool or ToolSpec(0.0, BALL_MM, flute_length_mm=30.0)
    return build_scene(Job(part=Part("none"), tool=tool), [face])


def moves(rows: list[tuple[str, list[float]]], axis: np.ndarray = UP) -> SimpleNamespace:
    tip = np.array([at for _, at in rows], dtype=float)
    return SimpleNamespace(
        kind=np.array([kind for kind, _ in rows]), tip=tip, axis=np.tile(axis, (len(tip), 1))
    )


def passes_over(slope: float, side_step: float) -> SimpleNamespace:
    """A ball end along y on the plane, its lowest point over the contact by the ball's lean."""
    normal = np.array([-slope, 0.0, 1.0]) / np.hypot(slope, 1.0)
    rows = []
    for x in np.arange(-12.0, 60.0, side_step):
        tip = np.array([x, 0.0, slope * x]) + BALL_MM * normal - BALL_MM * UP
        rows += [("rapid", [tip[0], -20.0, tip[2]]), ("cut", [tip[0], 60.0, tip[2]])]
    return moves(rows)
