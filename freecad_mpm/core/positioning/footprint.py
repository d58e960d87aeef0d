"""Where in plan the tool is to stand."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ... import _core
from ..base import Flags, Floats, Integers, Stages
from ..job import FootprintSpec, Job
from ..part import Scene

# What the core says of both steps together, and their keys.
BOTH_STEPS = "steps: ", "side_step_mm, forward_step_mm: "


@dataclass(frozen=True)
class Footprint:
    """Where in plan the tool is to stand: `points` (N, 2) mm in the set-up frame, `pass_index` (N,) from 0."""

    points: Floats
    pass_index: Integers


def lay_out(job: Job, scene: Scene, stages: Stages) -> Footprint:
    """The footprint over the faces to machine; where a pass leaves them it ends and a new one begins."""
    spec = job.footprint
    with job.blamed(spec.table):
        points, pass_index = stages.run("footprint", _raster, spec, *scene.model.machined_bounds())
    keep = stages.run("footprint", _core.restrict_to_faces, scene.model, scene.tool, points, spec.margin_mm)
    if not keep.any():
        raise job.error(
            spec.table, "side_step_mm", "gives no position over the faces to machine; it must be smaller"
        )
    return Footprint(points[keep], unbroken_runs(pass_index, keep))


def _raster(spec: FootprintSpec, low: Floats, high: Floats) -> tuple[Floats, Integers]:
    """Points and passes over the rectangle of plan that these corners span."""
    try:
        return _core.raster(
            low[:2],
            high[:2],
            direction_deg=spec.direction_deg,
            side_step_mm=spec.side_step_mm,
            forward_step_mm=spec.forward_step_mm,
            margin_mm=spec.margin_mm,
            zigzag=spec.zigzag,
        )
    except ValueError as error:
        raise ValueError(str(error).replace(*BOTH_STEPS, 1)) from None


def unbroken_runs(pass_index: Integers, keep: Flags) -> Integers:
    """Numbers from 0 of the runs of kept points that no other point and no end of a pass interrupts."""
    starts = keep.copy()
    starts[1:] &= ~keep[:-1] | (pass_index[1:] != pass_index[:-1])
    return np.asarray(np.cumsum(starts)[keep] - 1)
