"""Seeds and iterations of `dstm` by the published count: on the thesis' bicubics, and on surfaces of bi-degree 2 to 5.

The paper's own surfaces are not printed in what we have of it. Ours of bi-degree n are (n + 1)^2 control points over
150 x 150 mm whose heights wave both ways."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ... import _core
from ..base import Progress, Stages
from ..job import Job
from ..part import FaceArrays, prepare
from ..positioning import lay_out, make_positioner
from .comparison import Row, Run

METHOD = "dstm"
DEGREES = (2, 3, 4, 5)
SIZE_MM, BASE_MM, WAVE_MM = 150.0, 80.0, 20.0


def wave(degree: int) -> FaceArrays:
    """The surface of bi-degree `degree`."""
    at = np.linspace(0.0, 1.0, degree + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    height = BASE_MM + WAVE_MM * np.cos(5.0 * x + 0.4) * np.cos(4.0 * y - 0.3)
    knots = np.repeat([0.0, 1.0], degree + 1)
    poles = np.dstack((SIZE_MM * x, SIZE_MM * y, height))
    return FaceArrays("Face1", "bspline", degree, degree, knots, knots, poles)


def measure(runs: Sequence[Run], progress: Progress | None = None) -> list[Row]:
    """The surfaces of `runs` by `dstm`, then those of bi-degree 2 to 5 with the first one's tool and footprint."""
    spun = [run for run in runs if run.job.method.name == METHOD and run.threads == runs[0].threads]
    found = [_count(run.surface, run.job, None, progress) for run in spun]
    if not spun:
        return found
    job = spun[0].job
    for degree in DEGREES:
        named = replace(job, part=replace(job.part, file=f"bi-degree {degree}", faces=(), check_faces=()))
        found.append(_count(named.part.file, named, [wave(degree)], progress))
    return found


def _count(name: str, job: Job, faces: Sequence[FaceArrays] | None, progress: Progress | None) -> Row:
    """Seeds and iterations a position: of all positions, and of those that found two contacts."""
    stages = Stages(progress)
    scene = prepare(job, faces, stages)
    points = lay_out(job, scene, stages).points
    positioner = make_positioner(job, scene, stages)
    placed = stages.run_native("positions", positioner.place, points)
    two = np.array(_core.POSITION_STATUS)[placed["status"]] == "two_contacts"
    again = stages.run_native("positions", positioner.place, points[two])
    counts = {"seeds": placed["counters"]["seeds"], "newton_steps": placed["counters"]["newton_steps"]}
    row: Row = {"surface": name, "positions": len(points), "two_contacts": int(np.count_nonzero(two))}
    for key, value in counts.items():
        row[key] = value / len(points)
        row[f"{key}_found"] = again["counters"][key] / max(1, len(points[two]))
    return row
