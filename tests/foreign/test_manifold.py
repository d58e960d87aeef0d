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
from freecad_mpm.core import job, removal
from freecad_mpm.core.base import EXAMPLES, Stages
from freecad_mpm.core.part import prepare
from freecad_mpm.core.planning import plan

FOLDER = os.environ.get("MPM_MANIFOLD", "")
ROUND, ARC = 64, 8  # facets round the tool, and along a quarter of the corner
FIRST, MOVES, PARTS = (
    230,
    80,
    3,
)  # cuts of the path; each in so many hulls, for a hull fills the waist of a turning tool
HEIGHT = 30.0  # of the tool that is cut with, mm

# Places beside a point, mm: a wall between them shows.
ASIDE = 0.2 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1]])
# By so much a hull of two poses may reach beyond what the turning tool sweeps between them.
HULL_MM = 0.004

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
    """Where material that begins at the bottom ends over a point of the plan: the lowest place of triangles (T, 3, 3)
    that face up. A leaning tool leaves a roof above it."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        v = cross(point - a[:, :2], c - a) / area
        w = cross(b - a, point - a[:, :2]) / area
        hit = (area > 0) & (v >= 0) & (w >= 0) & (v + w <= 1)
    return (a[hit, 2] + v[hit] * (b - a)[hit, 2] + w[hit] * (c - a)[hit, 2]).min()


def our_heights(sweep, block, points):
    """Heights of our machined stock over points (N, 2) of the plan."""
    low, high = block[0][2], block[1][2]
    starts, up = np.insert(points, 2, low, axis=1), np.tile([0.0, 0.0, 1.0], (len(points), 1))
    full = np.full(len(points), high - low)
    height, _ = _core.cut_rays(sweep, starts, up, full, below_mm=0.0, context=_core.Context())
    return low + height


def top_of_faces(scene, points):
    """Heights of the saddle over points of the plan: its x and y are linear in its parameters."""
    face = scene.machined[0]
    surface = _core.BSplineSurface(face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles)
    return surface.evaluate(points[:, 0] / 150.0, points[:, 1] / 150.0)[:, 0, 2]


def cross(p, q):
    return p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]


def part_of(path):
    """Some cuts of a path that follow each other."""
    ends = np.flatnonzero(path.kind == "cut")[FIRST : FIRST + MOVES]
    rows = slice(ends[0] - 1, ends[-1] + 1)
    kind = np.where(path.kind[rows] == "cut", "cut", "rapid")
    return SimpleNamespace(kind=kind, tip=path.tip[rows], axis=path.axis[rows])


def hulls(tool, path):
    """The points whose hulls are to be taken off."""
    segments = []
    for i in np.flatnonzero(path.kind[1:] == "cut") + 1:
        skins = [cutter_points(tool, *pose(path, i, t)) for t in np.linspace(0, 1, PARTS + 1)]
        segments += [np.concatenate(pair).round(9).tolist() for pair in zip(skins, skins[1:])]
    return segments


def pose(path, i, t):
    axis = (1 - t) * path.axis[i - 1] + t * path.axis[i]
    return (1 - t) * path.tip[i - 1] + t * path.tip[i], axis / np.linalg.norm(axis)


def test_manifold_agrees_on_a_real_path():
    spec = job.load(EXAMPLES / "saddle.toml")
    spec = replace(spec, method=replace(spec.method, name="vcrf"))
    path = part_of(plan(spec).path)
    spec = replace(spec, tool=replace(spec.tool, recess_mm=0.0, flute_length_mm=HEIGHT, shank=(), holder=()))
    scene = prepare(spec, None, Stages())
    segments = hulls(scene.tool, path)
    block = (np.array([30.0, 20.0, 60.0]), np.array([90.0, 130.0, 110.0]))
    points = np.random.default_rng(5).uniform([36, 26], [84, 124], (1500, 2))

    theirs = foreign_heights(block, segments, points)
    sweep = removal.tool_sweep(scene, path)
    ours = our_heights(sweep, block, points)
    beside = [our_heights(sweep, block, points + aside) for aside in ASIDE]

    # Their facets lie inside the true cutter by its sagittas round the axis and along the corner.
    round_sag = scene.tool.radius * (1 - np.cos(np.pi / ROUND))
    corner_sag = scene.tool.minor_radius * (1 - np.cos(np.pi / 4 / ARC))
    facets = round_sag + corner_sag
    # The pass's floor: on its steep sides a difference sideways becomes a large one in height.
    floor = np.max([ours, *beside], axis=0) < top_of_faces(scene, points) + 1.0
    difference = (theirs - ours)[floor]
    assert floor.sum() > 300
    print(
        f"manifold: {len(segments)} hulls, {floor.sum()} points, theirs - ours {difference.min():+.4f}"
        f" .. {difference.max():+.4f} mm, median {np.median(difference):+.4f}, facets {facets:.4f}"
    )
    assert difference.min() > -HULL_MM
    assert difference.max() < 1.5 * facets  # the height of a difference on the slope of the corner
