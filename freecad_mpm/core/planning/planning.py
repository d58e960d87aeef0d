"""The façade: the stages of a plan in order, each one native call over arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base import Cancel, Floats, Progress, Stages
from ..job import PROVEN, Job
from ..machine import fit_to_machine, with_rapids_proven
from ..part import FaceArrays, Scene, prepare
from ..path import STAGE, link, path_in_part, prove
from ..positioning import (
    Footprint,
    Positions,
    as_positions,
    check_method,
    guarantee_of,
    lay_out,
    make_positioner,
    place,
    positions_in_part,
    sample,
    spacing,
)
from ..program import ProgramPart, find_shop, make_program
from ..report import judge, make_report
from .result import Plan


def plan(
    job: Job,
    faces: Sequence[FaceArrays] | None = None,
    on_progress: Progress | None = None,
    cancel: Cancel | None = None,
    threads: int = 0,
) -> Plan:
    """Compute a job: positions, path, program and report.

    faces:       of the part, in its frame; default: read from `job.part.file`.
    on_progress: called in this thread as on_progress(stage, fraction 0..1).
    cancel:      a threading.Event or a function; when it is set or true the plan stops within 0.1 s.
    threads:     for the native stages, 0: all cores. The result does not depend on it.

    Raises InputError for a job that cannot be computed as it stands, Cancelled when cancelled. What the mathematics
    brings – a position without a second contact, a gouge – is a status in the result, never an exception."""
    shop = find_shop(job)
    check_method(job)
    stages = Stages(on_progress, cancel, threads)
    scene = prepare(job, faces, stages)
    footprint = lay_out(job, scene, stages)
    placed = place_and_prove(job, scene, footprint, stages)
    positions = placed.positions
    path = link(job, scene, positions, placed.cuts, stages)
    path, joints = fit_to_machine(job, shop.machine, scene, path, guarantee_of(job), stages)
    path = with_rapids_proven(job, shop.machine, scene, path, joints, stages)
    made = make_program(job, shop, [ProgramPart(path, joints, scene.model.bounds())], stages)
    positions, path = positions_in_part(positions, scene.frame), path_in_part(path, scene.frame)
    verdict = judge(
        positions, path, made.troubles, job.tolerance, guarantee_of(job), job.footprint.allow_gaps
    )
    kept = _kept_spacing(job, scene, positions, placed)
    told = make_report(
        job, shop.machine, positions, path, made, verdict, placed.counters, stages.seconds, kept
    )
    return Plan(positions, path, job, scene, joints, made.program, told)


@dataclass(frozen=True)
class Placed:
    """Positions in the set-up frame and what was found out with them."""

    positions: Positions
    cuts: Floats | None  # (N,) mm: proven clearances of the cuts that end in the positions; None: nobody proved any
    nearest: spacing.Nearest  # empty unless the job wants a contact spacing
    counters: dict[str, int]


def place_and_prove(job: Job, scene: Scene, footprint: Footprint, stages: Stages) -> Placed:
    """The positions; of a proven method also proven cuts, with positions put in between where it takes them."""
    positioner = make_positioner(job, scene, stages)
    positions, nearest, counters = place(job, scene, positioner, footprint, stages)
    if guarantee_of(job) != PROVEN:
        return Placed(positions, None, nearest, counters)

    def place_more(points: Floats, spins_deg: Floats) -> Positions:
        own = spins_deg if job.method.contact_spacing_mm else None
        placed = stages.run_native(STAGE, positioner.place, points, spins_deg=own)
        for name, value in placed["counters"].items():
            counters[name] += value
        passes = np.zeros(len(points), dtype=np.int64)
        return sample(scene, as_positions(Footprint(points, passes), placed), stages, STAGE)

    proven = prove(job, scene, footprint.points, positions, place_more, stages)
    return Placed(proven.positions, proven.cut_clearance, nearest, counters | {"motion_cells": proven.cells})


def _kept_spacing(job: Job, scene: Scene, positions: Positions, placed: Placed) -> spacing.KeptSpacing | None:
    """How well the job's contact spacing was kept; None where it wants none."""
    if not job.method.contact_spacing_mm:
        return None
    along = scene.frame.direction_to_part(spacing.feed(job.footprint.direction_deg))
    return spacing.kept_spacing(job.method, positions, placed.nearest, along)
