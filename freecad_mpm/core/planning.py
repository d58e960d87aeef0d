"""The façade: the stages of a plan in order, each one native call over arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .. import _core
from . import motions, report, spacing
from .errors import blame
from .faces import FaceArrays
from .frame import Frame
from .job import Job, MethodSpec
from .linking import link_options
from .model import Scene, build_scene
from .part_file import read_part
from .plan import Flags, Floats, Integers, Path, Plan, Positions
from .rapids import with_rapids_proven
from .rewind import fit_to_machine
from .sections import suggestion
from .shop import find_shop, make_program
from .stages import Cancel, Progress, Stages
from .verdict import PROVEN, judge


@dataclass(frozen=True)
class Footprint:
    """Where in plan the tool is to stand: `points` (N, 2) mm in the set-up frame, `pass_index` (N,) from 0."""

    points: Floats
    pass_index: Integers


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
    path, joints = fit_to_machine(job, shop, scene, path, guarantee_of(job), stages)
    path = with_rapids_proven(job, shop, scene, path, joints, stages)
    made = make_program(job, shop, path, joints, scene.model.bounds(), stages)
    positions, path = positions_in_part(positions, scene.frame), path_in_part(path, scene.frame)
    verdict = judge(
        positions, path, made.troubles, job.tolerance, guarantee_of(job), job.footprint.allow_gaps
    )
    facts = report.facts(job, shop.machine, positions, path, made, placed.counters, stages.seconds, verdict)
    if job.method.contact_spacing_mm:
        along = scene.frame.direction_to_part(spacing.feed(job.footprint.direction_deg))
        facts["contact_spacing"] = spacing.facts(job.method, positions, placed.nearest, along)
    return Plan(
        **vars(positions),
        job=job,
        scene=scene,
        path=path,
        joints=made.joints,
        program=made.program,
        report=facts,
    )


def method_names() -> list[str]:
    """The methods of the core, in its order."""
    return list(_core.METHODS)


def guarantee_of(job: Job) -> str:
    """What the job's method says of its clearances: "sampled" or "proven"."""
    return str(_core.METHODS[job.method.name]["guarantee"])


def check_method(job: Job) -> None:
    """Raise InputError unless the core has the job's method and its options."""
    method = job.method
    if method.name not in _core.METHODS:
        raise job.error(
            MethodSpec.table,
            "name",
            f"unknown method '{method.name}'{suggestion(method.name, _core.METHODS)}",
        )
    if method.contact_spacing_mm and not _core.METHODS[method.name]["spins"]:
        able = " and ".join(name for name, one in _core.METHODS.items() if one["spins"])
        raise job.error(
            MethodSpec.table,
            "contact_spacing_mm",
            f"must be 0 for {method.name}, which cannot spin; {able} can",
        )
    known = _core.METHODS[method.name]["options"]
    for name, value in method.options.items():
        if name not in known:
            raise job.error(MethodSpec.table, f"options.{name}", f"unknown option{suggestion(name, known)}")
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise job.error(MethodSpec.table, f"options.{name}", f"must be a number, got {value!r}")


def prepare(job: Job, faces: Sequence[FaceArrays] | None, stages: Stages) -> Scene:
    """Read the part unless its faces are given, and build the native model and tool.

    Trim polygons may be off by the gouge tolerance: a border that they cut short is a gouge nobody sees."""
    if faces is None:
        with blame(f"{job.source}: [{job.part.table}] file:"):
            faces = stages.run("read", read_part, job.part.file, job.tolerance.gouge_mm)
    return stages.run("model", build_scene, job, faces)


def lay_out(job: Job, scene: Scene, stages: Stages) -> Footprint:
    """The footprint over the faces to machine; where a pass leaves them it ends and a new one begins."""
    spec = job.footprint
    low, high = scene.model.machined_bounds()
    with blame(f"{job.source}: [{spec.table}]"):
        points, pass_index = stages.run(
            "footprint",
            _core.raster,
            low[:2],
            high[:2],
            direction_deg=spec.direction_deg,
            side_step_mm=spec.side_step_mm,
            forward_step_mm=spec.forward_step_mm,
            margin_mm=spec.margin_mm,
            zigzag=spec.zigzag,
        )
    keep = stages.run("footprint", _core.restrict_to_faces, scene.model, scene.tool, points, spec.margin_mm)
    if not keep.any():
        raise job.error(
            spec.table, "side_step_mm", "gives no position over the faces to machine; it must be smaller"
        )
    return Footprint(points[keep], unbroken_runs(pass_index, keep))


def unbroken_runs(pass_index: Integers, keep: Flags) -> Integers:
    """Numbers from 0 of the runs of kept points that no other point and no end of a pass interrupts."""
    starts = keep.copy()
    starts[1:] &= ~keep[:-1] | (pass_index[1:] != pass_index[:-1])
    return np.asarray(np.cumsum(starts)[keep] - 1)


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
        placed = stages.run_native(motions.STAGE, positioner.place, points, spins_deg=own)
        for name, value in placed.pop("counters").items():
            counters[name] += value
        passes = np.zeros(len(points), dtype=np.int64)
        return sample(scene, as_positions(Footprint(points, passes), placed), stages, motions.STAGE)

    proven = motions.prove(job, scene, footprint.points, positions, place_more, stages)
    return Placed(proven.positions, proven.cut_clearance, nearest, counters | {"motion_cells": proven.cells})


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

    with blame(f"{job.source}: [{method.table}]"):
        return stages.run_native("index", make)


def method_options(job: Job) -> dict[str, float]:
    """The method's options: what it may cut in is the job's gouge tolerance, unless its own table says otherwise."""
    options: dict[str, float] = dict(job.method.options)
    if "gouge_mm" in _core.METHODS[job.method.name]["options"]:
        options.setdefault("gouge_mm", job.tolerance.gouge_mm)
    return options


def place(
    job: Job, scene: Scene, positioner: _core.Positioner, footprint: Footprint, stages: Stages
) -> tuple[Positions, spacing.Nearest, dict[str, int]]:
    """Positions in the set-up frame, what contact spacings come nearest to a wanted one, and the method's counters."""
    method, nearest = job.method, spacing.Nearest()
    with blame(f"{job.source}: [{MethodSpec.table}]"):
        if method.contact_spacing_mm:
            placed = stages.run_native(
                "positions",
                positioner.place_spaced,
                footprint.points,
                footprint.pass_index,
                method.contact_spacing_mm,
                measure=method.spacing_measure,
                feed=spacing.feed(job.footprint.direction_deg),
            )
            placed.pop("contact_spacing_mm")
            nearest = spacing.Nearest(footprint.points, placed.pop("nearest_spacing_mm"))
        else:
            placed = stages.run_native("positions", positioner.place, footprint.points)
    counters = placed.pop("counters")
    return sample(scene, as_positions(footprint, placed), stages, "judge"), nearest, counters


def as_positions(footprint: Footprint, placed: dict[str, Any]) -> Positions:
    """What a positioner placed over the footprint."""
    status = np.array(_core.POSITION_STATUS)[placed.pop("status")]
    of_footprint = np.zeros(len(footprint.points), dtype=bool)
    return Positions(**placed, status=status, pass_index=footprint.pass_index, inserted=of_footprint)


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


def link(job: Job, scene: Scene, positions: Positions, cuts: Floats | None, stages: Stages) -> Path:
    """The path over the usable positions, in the set-up frame. cuts: (N,) proven clearances of the cuts that end in the
    positions, NaN where there must be none; None: sampling decides."""
    with blame(f"{job.source}: [{job.link.table}]"):
        linked = stages.run_native(
            "path",
            _core.link_passes,
            scene.cells,
            scene.tool,
            positions.tip,
            positions.axis,
            positions.pass_index,
            positions.usable,
            options=link_options(job, guarantee_of(job)),
            cut_clearance=cuts,
        )
    linked["kind"] = np.array(_core.MOVE_KINDS)[linked["kind"]]
    if len(linked["kind"]) == 0:
        raise job.error(
            MethodSpec.table, "name", f"{job.method.name} found no usable position for this tool and part"
        )
    return Path(**linked)


def positions_in_part(positions: Positions, frame: Frame) -> Positions:
    return replace(
        positions,
        tip=frame.to_part(positions.tip),
        axis=frame.direction_to_part(positions.axis),
        contacts=frame.to_part(positions.contacts),
        normals=frame.direction_to_part(positions.normals),
    )


def path_in_part(path: Path, frame: Frame) -> Path:
    return replace(path, tip=frame.to_part(path.tip), axis=frame.direction_to_part(path.axis))
