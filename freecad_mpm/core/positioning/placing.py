"""Placing the tool over a footprint."""

from __future__ import annotations

import numpy as np

from ... import _core
from ..base import Stages
from ..job import Job, MethodSpec
from ..part import Scene
from . import spacing
from .footprint import Footprint
from .methods import method_options
from .positions import Positions


def make_positioner(job: Job, scene: Scene, stages: Stages) -> _core.Positioner:
    """The job's method made ready for the scene: what it precomputes counts as the stage "index"."""
    method = job.method

    def make(context: _core.Context) -> _core.Positioner:
        return _core.Positioner(
            method.name,
            scene.model,
            scene.tool,
            tilt_max_deg=method.tilt_max_deg,
            spin_deg=method.spin_deg,
            options=method_options(job),
            cells=scene.cells,
        )

    with job.blamed(method.table):
        return stages.run_native("index", make)


def place(
    job: Job, scene: Scene, positioner: _core.Positioner, footprint: Footprint, stages: Stages
) -> tuple[Positions, spacing.Nearest, dict[str, int]]:
    """Positions in the set-up frame, what contact spacings come nearest to a wanted one, and the method's counters."""
    method, nearest = job.method, spacing.Nearest()
    with job.blamed(MethodSpec.table):
        if method.contact_spacing_mm:
            spaced = stages.run_native(
                "positions",
                positioner.place_spaced,
                footprint.points,
                footprint.pass_index,
                method.contact_spacing_mm,
                measure=method.spacing_measure,
                feed=spacing.feed(job.footprint.direction_deg),
            )
            nearest = spacing.Nearest(footprint.points, spaced["nearest_spacing_mm"])
            placed: _core.Placements = spaced
        else:
            placed = stages.run_native("positions", positioner.place, footprint.points)
    return sample(scene, as_positions(footprint, placed), stages, "judge"), nearest, placed["counters"]


def as_positions(footprint: Footprint, placed: _core.Placements) -> Positions:
    """What a positioner placed over the footprint. A spin may turn the axis of a tool on a steep wall below the horizon,
    where no spindle is: nobody can go there, so that position is undecided."""
    status = np.array(_core.POSITION_STATUS)[placed["status"]]
    status[placed["axis"][:, 2] <= 0.0] = "undecided"
    return Positions(
        tip=placed["tip"],
        axis=placed["axis"],
        contacts=placed["contacts"],
        normals=placed["normals"],
        status=status,
        clearance=placed["clearance"],
        tilt_deg=placed["tilt_deg"],
        spin_deg=placed["spin_deg"],
        pass_index=footprint.pass_index,
        inserted=np.zeros(len(footprint.points), dtype=bool),
    )


def sample(scene: Scene, positions: Positions, stages: Stages, stage: str) -> Positions:
    """The same positions; a second opinion by dense sampling has lowered the upper bounds of their clearances."""
    usable = positions.usable
    sampled = stages.run_native(
        stage,
        _core.sampled_clearance,
        scene.model,
        scene.tool,
        positions.tip[usable],
        positions.axis[usable],
    )
    positions.clearance[usable, 1] = np.minimum(positions.clearance[usable, 1], sampled)
    return positions
