"""A foreign opinion on removal: the library manifold-3d (npm) cuts the same segments.

Skipped, and counted as skipped, unless MPM_MANIFOLD names a folder in which `npm install manifold-3d` was run."""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core import cutting, job, planning
from freecad_mpm.core.resources import EXAMPLES
from freecad_mpm.core.stages import Stages

FOLDER = os.environ.get("MPM_MANIFOLD", "")
ROUND, ARC = 64, 8  # facets round the tool, and along a quarter of the corner
SEGMENTS = 220
HEIGHT = 30.0  # of the tool that is cut with, mm

pytestmark = pytest.mark.skipif(
    not (Path(FOLDER) / "node_modules" / "manifold-3d").is_dir() or not FOLDER,
    reason="MPM_MANIFOLD names no folder with node_modules/manifold-3d",
)


def cutter_points(tool, tip, axis):
    """Points of the cutter's skin at a pose: its hull is a faceted cutter inside the true one."""
    corner = np.linspace(-np.pi / 2, 0, ARC + 1)
    r = tool.major_radius + tool.minor_radius * np.cos(corner)
    z = tool.minor_radius * (1 + np.sin(corner))
    r, z = np.append(r, r[-1]), np.append(z, HEIGHT)
    x = np.cross(axis, [0.0, 1.0, 0.0])
    x /= np.linalg.norm(x)
    y = np.cross(axis, x)
    turn = 2 * np.pi * np.arange(ROUND) / ROUND
    around = np.outer(np.cos(turn), x) + np.outer(np.sin(turn), y)
    return (tip + r[:, None, None] * around + z[:, None, None] * axis).reshape(-1, 3)


def foreign_heights(block, segments, plan_points):
    """Heights of the foreign machined stock over points (N, 2) of the plan."""
    said = subprocess.run(
        ["node", str(Path(__file__).with_name("manifold_cut.mjs")), FOLDER],
        input=json.dumps({"block": [list(corner) for corner in block], "segments": segments}),
        capture_output=True,
        text=True,
        check=True,
    )
    mesh = json.loads(said.stdout)
    corners = np.array(mesh["vertices"])[np.array(mesh["triangles"])]
    return np.array([top_of(corners, point) for point in plan_points])


def top_of(corners, point):
    """The highest place of triangles (T, 3, 3) over a point of the plan."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        v = cross(point - a[:, :2], c - a) / area
        w = cross(b - a, point - a[:, :2]) / area
    hit = (area != 0) & (v >= 0) & (w >= 0) & (v + w <= 1)
    return (a[hit, 2] + v[hit] * (b - a)[hit, 2] + w[hit] * (c - a)[hit, 2]).max()


def cross(p, q):
    return p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]


def test_manifold_agrees_on_a_real_path():
    spec = job.load(EXAMPLES / "saddle.toml")
    spec = replace(spec, method=replace(spec.method, name="vcrf"))
    plan = planning.plan(spec)
    ends = np.flatnonzero(plan.path.kind == "cut")[152 : 152 + SEGMENTS]  # from the third pass on
    first, last = ends[0] - 1, ends[-1]
    path = SimpleNamespace(
        kind=plan.path.kind[first : last + 1],
        tip=plan.path.tip[first : last + 1],
        axis=plan.path.axis[first : last + 1],
    )
    spec = replace(spec, tool=replace(spec.tool, recess_mm=0.0, flute_length_mm=HEIGHT, shank=(), holder=()))
    scene = planning.prepare(spec, None, Stages())
    path = SimpleNamespace(kind=np.where(path.kind == "cut", "cut", "rapid"), tip=path.tip, axis=path.axis)

    skins = [cutter_points(scene.tool, tip, axis) for tip, axis in zip(path.tip, path.axis)]
    cuts = np.flatnonzero(path.kind == "cut")
    cuts = cuts[cuts > 0]
    segments = [np.concatenate([skins[i - 1], skins[i]]).round(9).tolist() for i in cuts]
    block = (np.array([30.0, 20.0, 60.0]), np.array([90.0, 130.0, 110.0]))
    points = np.random.default_rng(5).uniform([36, 26], [84, 124], (1500, 2))

    theirs = foreign_heights(block, segments, points)
    starts = np.column_stack([points, np.full(len(points), block[0][2])])
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    sweep = cutting.tool_sweep(scene, path)
    height, _ = _core.cut_rays(
        sweep, starts, up, np.full(len(points), block[1][2] - block[0][2]), below_mm=0.0, context=_core.Context()
    )
    ours = block[0][2] + height

    # Their facets lie inside the true cutter by its sagittas round the axis and along the corner.
    round_sag = scene.tool.radius * (1 - np.cos(np.pi / ROUND))
    corner_sag = scene.tool.minor_radius * (1 - np.cos(np.pi / 4 / ARC))
    slack = (round_sag + corner_sag) * 1.5
    cut_there = ours < block[1][2] - 1e-6
    difference = (theirs - ours)[cut_there]
    assert cut_there.sum() > 1000
    print(f"manifold: {len(segments)} segments, {cut_there.sum()} points, theirs - ours {difference.min():+.4f}"
          f" .. {difference.max():+.4f} mm, median {np.median(difference):+.4f}, facets {round_sag + corner_sag:.4f}")
    # Steep places turn a sideways difference into a higher one: all but a few points within the facets.
    assert difference.min() > -1e-3
    assert np.percentile(difference, 99) < slack
