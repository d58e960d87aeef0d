"""How deep a path cuts into faces that are not machined, and how deep the tool itself enters any face."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ... import _core
from ..base import Floats, Integers, Stages
from ..part import Scene, surface_model
from .sweep import Box, PathMoves, reach, way

STAGE = "check faces"


@dataclass(frozen=True, eq=False)
class Overcut:
    """The check faces where the tool can come; part frame, mm.

    Kept are the points that are cut and their neighbours: K of `looked_at`."""

    looked_at: int
    points: Floats  # (K, 3), on the check faces
    depth_mm: Floats  # (K,), how deep the point lay inside the tool, 0: never in it
    move: Integers  # (K,), row of the path whose move went deepest there, -1: none did
    face: Integers  # (K,), index into Scene.check
    triangles: NDArray[np.uint32]  # (T, 3) of points


def overcut(scene: Scene, path: PathMoves, spacing_mm: float, box: Box | None, stages: Stages) -> Overcut:
    """Look at points of the check faces at most about `spacing_mm` apart, in `box` (set-up frame) when it is given.

    The depth is that by which plans are judged, the tool's own, not along a normal: a face's outer side need not be
    known, and near an edge it is no deeper than the tool is. Raises ValueError for too many points."""
    region = reach(scene, path)
    if box is not None:
        region = Box(np.maximum(region.lo, box.lo), np.minimum(region.hi, box.hi))
    if not scene.check or (region.lo > region.hi).any():
        return _empty()
    model = surface_model(scene.check, [], scene.frame)
    samples = stages.run_native(
        STAGE, _core.sample_surfaces, model, spacing_mm=spacing_mm, lo=region.lo, hi=region.hi
    )
    depth, move = depths(scene, path, samples["points"], stages)
    if box is not None:
        aside = ((samples["points"] < box.lo) | (samples["points"] > box.hi)).any(axis=1)
        depth[aside], move[aside] = 0.0, -1
    return _around_cuts(scene, samples, depth, move)


def depths(scene: Scene, path: PathMoves, points: Floats, stages: Stages) -> tuple[Floats, Integers]:
    """Depth (N,) inside the tool of any `points` (N, 3) (set-up frame), and the moves (N,) that go deepest."""
    depth, move = stages.run_native(STAGE, _core.overcut, scene.tool, *way(scene, path), points)
    return depth, move.astype(np.int64)


def _around_cuts(scene: Scene, samples: _core.SurfaceSamples, depth: Floats, move: Integers) -> Overcut:
    triangles = samples["triangles"]
    shown = triangles[(depth[triangles] > 0).any(axis=1)]
    kept = depth > 0
    kept[shown] = True
    number = np.cumsum(kept) - 1
    return Overcut(
        len(depth),
        scene.frame.to_part(samples["points"][kept]),
        depth[kept],
        move[kept],
        samples["face"][kept].astype(np.int64),
        number[shown].astype(np.uint32),
    )


def _empty() -> Overcut:
    none = np.zeros(0, dtype=np.int64)
    return Overcut(0, np.zeros((0, 3)), np.zeros(0), none, none, np.zeros((0, 3), dtype=np.uint32))
