"""Cutting a path into the stock, and the deviation of what is left (docs/removal.md)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ... import _core
from ..base import Cancel, Floats, Integers, Progress, Stages
from ..part import Scene
from .overcut import Overcut, depths, overcut
from .plane_curve import Curve, curve
from .section import Section
from .sweep import Box, PathMoves, tool_sweep

# Points of a section lie at most so far apart unless it is asked otherwise: a cusp shows.
SECTION_SPACING_MM = 0.05

# The stock reaches this part of its height below the lowest point of the faces, and at least a cell.
BASE_DEPTH = 0.1
# Of the points that may be too deep, so many are looked at before it is asked whether one was.
POINTS_AT_A_TIME = 1000
# Dexels along the longer side of a stock whose resolution nobody names: a 150 mm part gets 0.5 mm.
DEXELS_ALONG = 300


class Mesh(NamedTuple):
    """A closed surface: `vertices` (V, 3) mm, part frame; `triangles` (T, 3), counter-clockwise seen from outside."""

    vertices: Floats
    triangles: NDArray[np.uint32]


@dataclass(frozen=True, eq=False)
class Deviation:
    """The machined surface against the true one at N points of the faces to machine; part frame, mm."""

    points: Floats  # (N, 3), on the true surface
    normals: Floats  # (N, 3), unit, out of the part
    deviation_mm: Floats  # (N,), along the normal: > 0 remains, < 0 is cut in, down to -Cut.below_mm
    move: Integers  # (N,), row of the path whose move cut there last, -1: none did
    face: Integers  # (N,), index into Scene.machined
    at: Floats  # (N, 2), parameters (u, v) of the points on their faces
    triangles: NDArray[
        np.uint32
    ]  # (T, 3) of points, for colouring; trimmed faces end up to a sample short of their border


class Extreme(NamedTuple):
    """A place of the deviation: how much, where, and after which move (row of the path, -1: none)."""

    deviation_mm: float
    point: Floats  # (3,), on the true surface, part frame
    move: int


NOT_CUT = Extreme(0.0, np.zeros(3), -1)


class Worst(NamedTuple):
    """The deepest gouge (the least deviation, above 0 when there is no gouge), the largest remainder, and the deepest
    cut into a check face (`deviation_mm` is minus how deep the point lay in the tool), None when none is cut.
    """

    gouge: Extreme
    remainder: Extreme
    check: Extreme | None


@dataclass(frozen=True, eq=False)
class Cut:
    """What `cut` found."""

    scene: Scene
    path: PathMoves
    resolution_mm: float
    stock: Box  # set-up frame
    deviation: Deviation
    overcut: Overcut  # of the check faces
    below_mm: float  # gouges deeper than this are given as so deep
    sweep: _core.ToolSweep  # of the path, for more rays
    dexels: _core.DexelStock | None  # after the cut; None: `with_stock` was False
    seconds: dict[str, float]  # wall time of the stages

    def mesh(self) -> Mesh:
        """The machined stock. Raises ValueError when it was not cut (`with_stock`)."""
        if self.dexels is None:
            raise ValueError("with_stock must be True for a mesh")
        return _mesh(self.scene, self.dexels)

    def worst(self) -> Worst:
        """Over all points of the deviation and of the check faces."""
        values = self.deviation.deviation_mm
        gouge, remainder = (self._extreme(int(which(values))) for which in (np.argmin, np.argmax))
        return Worst(gouge, remainder, self._deepest_in_check_faces())

    def good(self, depth_mm: float) -> bool:
        """No point of any face, machined or not, lay deeper inside the tool than `depth_mm`.

        That is the depth by which plans are judged; along the normal, near a sharp edge, the deviation may be more.
        """
        if (self.overcut.depth_mm > depth_mm).any():
            return False
        values = self.deviation.deviation_mm
        rows = np.flatnonzero(values < -depth_mm)  # nowhere else can the tool be so deep
        for some in np.array_split(rows[np.argsort(values[rows])], max(1, len(rows) // POINTS_AT_A_TIME)):
            if (self.depth_mm(self.deviation.points[some]) > depth_mm).any():
                return False
        return True

    def depth_mm(self, points: Floats) -> Floats:
        """How deep (N,) any points (N, 3) (part frame) lay inside the tool; 0: never in it."""
        return depths(self.scene, self.path, self.scene.frame.to_setup(points), Stages())[0]

    def heights(self, points: Floats, directions: Floats) -> tuple[Floats, Integers]:
        """Deviation (N,) along `directions` (N, 3) at any `points` (N, 3) of the true surface (part frame), and the
        moves (N,) that cut there: exact, whatever the resolution."""
        frame = self.scene.frame
        return cut_rays(
            self.sweep,
            frame.to_setup(points),
            frame.direction_to_setup(directions),
            self.stock,
            self.below_mm,
            _core.Context(),
        )

    def section(
        self, origin: Sequence[float], normal: Sequence[float], spacing_mm: float = SECTION_SPACING_MM
    ) -> Section:
        """The machined surface along a plane (part frame): `plane_curve.curve`, measured."""
        return self.along(curve(self.scene, origin, normal, spacing_mm))

    def along(self, of: Curve) -> Section:
        """The machined surface along a curve."""
        deviation, move = self.heights(of.points, of.normals)
        return Section(of.plane, of.piece, of.points, of.normals, deviation, move)

    def _deepest_in_check_faces(self) -> Extreme | None:
        found = self.overcut
        if not (found.depth_mm > 0).any():
            return None
        i = int(np.argmax(found.depth_mm))
        return Extreme(-float(found.depth_mm[i]), found.points[i], int(found.move[i]))

    def _extreme(self, i: int) -> Extreme:
        found = self.deviation
        return Extreme(float(found.deviation_mm[i]), found.points[i], int(found.move[i]))


def cut(
    scene: Scene,
    path: PathMoves,
    resolution_mm: float = 0.5,
    *,
    box: tuple[Sequence[float], Sequence[float]] | None = None,
    with_stock: bool = True,
    on_progress: Progress | None = None,
    cancel: Cancel | None = None,
    threads: int = 0,
) -> Cut:
    """Take everything that the tool sweeps on its way out of a block of stock, and measure what is left.

    scene:         the part's faces and the tool (`Plan.scene`).
    path:          the moves (part frame); all but rapids cut, with ring, bottom, flutes, shank and holder. Between two
                   rows the tip goes straight and the axis along a great circle.
    resolution_mm: distance of the dexels and of the points of the deviation; the values themselves do not depend on it.
    box:           lo, hi (set-up frame) of the stock; default: the faces' box, and some base below it. A small box with
                   a small resolution looks closely at one place: points outside of it are left out.
    with_stock:    cut the block too, for `Cut.mesh`; False measures the deviation only, in a small part of the time.
    on_progress:   called in this thread as on_progress(stage, fraction 0..1).
    cancel:        a threading.Event or a function; when it is set or true, Cancelled is raised within 0.1 s.
    threads:       0: all cores. The result does not depend on it.

    `cut_memory` says beforehand how many bytes it takes. Raises ValueError naming the argument that is wrong.
    """
    stages = Stages(on_progress, cancel, threads)
    stock = stock_box(scene, box, resolution_mm)
    sweep = tool_sweep(scene, path)
    deviation = _deviation(scene, sweep, stock, box is not None, resolution_mm, stages)
    into_checks = overcut(scene, path, resolution_mm, None if box is None else stock, stages)
    dexels = _cut_dexels(sweep, stock, resolution_mm, stages) if with_stock else None
    below = scene.tool.radius
    return Cut(
        scene, path, resolution_mm, stock, deviation, into_checks, below, sweep, dexels, stages.seconds
    )


def default_resolution_mm(scene: Scene) -> float:
    """A resolution at which the whole part is quickly cut."""
    lo, hi = scene.model.bounds()
    return float((hi - lo)[:2].max()) / DEXELS_ALONG


def cut_rays(
    sweep: _core.ToolSweep,
    points: Floats,
    directions: Floats,
    stock: Box,
    below_mm: float,
    context: _core.Context,
) -> tuple[Floats, Integers]:
    """Heights (N,) and moves (N,) on rays from `points` along `directions` (N, 3) (set-up frame) that material fills up
    to the top of the stock; beside the stock's box it goes on for `below_mm`, so that a border has its scallops.
    """
    aside = np.array([below_mm, below_mm, 0.0])
    full = _way_out(points, directions, Box(stock.lo - aside, stock.hi + aside))
    height, move = _core.cut_rays(sweep, points, directions, full, below_mm=below_mm, context=context)
    return height, move.astype(np.int64)


def _way_out(points: Floats, directions: Floats, box: Box) -> Floats:
    """(N,): how far each ray goes until it leaves the box, 0 for points outside."""
    far = np.full(len(points), np.inf)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in range(3):
            way = (np.where(directions[:, k] > 0, box.hi[k], box.lo[k]) - points[:, k]) / directions[:, k]
            np.minimum(far, np.where(directions[:, k] == 0, np.inf, way), out=far)
    return np.maximum(far, 0.0)


def _cut_dexels(sweep: _core.ToolSweep, stock: Box, resolution_mm: float, stages: Stages) -> _core.DexelStock:
    dexels = _core.DexelStock(stock.lo, stock.hi, resolution_mm)
    stages.run_native("stock", dexels.cut, sweep)
    return dexels


def _mesh(scene: Scene, dexels: _core.DexelStock) -> Mesh:
    vertices, triangles = dexels.mesh()
    return Mesh(scene.frame.to_part(vertices), triangles)


def stock_box(scene: Scene, box: tuple[Sequence[float], Sequence[float]] | None, resolution_mm: float) -> Box:
    """In mm, set-up frame: the faces' bounds, deepened by a base, when none is given. ValueError for an empty one."""
    if not (np.isfinite(resolution_mm) and resolution_mm > 0):
        raise ValueError(f"resolution_mm must be a positive number, got {resolution_mm}")
    lo, hi = (np.array(corner, dtype=np.float64) for corner in (box or scene.model.bounds()))
    if lo.shape != (3,) or hi.shape != (3,) or not (lo < hi + (box is None)).all():
        raise ValueError(f"box must be lo and hi of three numbers each, lo < hi, got {box}")
    if box is None:
        lo[2] -= max(BASE_DEPTH * (hi[2] - lo[2]), 2 * resolution_mm)
    return Box(lo, hi)


def _deviation(
    scene: Scene,
    sweep: _core.ToolSweep,
    stock: Box,
    only_inside: bool,
    spacing_mm: float,
    stages: Stages,
) -> Deviation:
    samples = stages.run_native(
        "samples", _core.sample_surfaces, scene.model, spacing_mm=spacing_mm, lo=stock.lo, hi=stock.hi
    )
    if only_inside:
        samples = _inside(samples, stock)
    points, normals = samples["points"], samples["normals"]
    height, move = stages.run_native("deviation", cut_rays, sweep, points, normals, stock, scene.tool.radius)
    return Deviation(
        scene.frame.to_part(points),
        scene.frame.direction_to_part(normals),
        height,
        move,
        samples["face"].astype(np.int64),
        samples["at"],
        samples["triangles"],
    )


def _inside(samples: _core.SurfaceSamples, stock: Box) -> _core.SurfaceSamples:
    """Only the samples in the box, and the triangles between them."""
    kept = ((samples["points"] >= stock.lo) & (samples["points"] <= stock.hi)).all(axis=1)
    if not kept.any():
        raise ValueError("box: no point of the faces to machine lies in it")
    number = np.cumsum(kept) - 1
    triangles = samples["triangles"][kept[samples["triangles"]].all(axis=1)]
    return {
        "points": samples["points"][kept],
        "normals": samples["normals"][kept],
        "at": samples["at"][kept],
        "face": samples["face"][kept],
        "triangles": number[triangles].astype(np.uint32),
    }
