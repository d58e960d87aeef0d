"""The command `cut`: a job's plan, a CL file or a program's text, cut into the stock and measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import PurePath
from typing import Any

import numpy as np

from . import cl_file, cut_picture, cut_report, cutting, job, mesh_file, planning
from .errors import InputError, blame
from .job import Job
from .model import Scene
from .program_moves import ProgramMoves, read_program
from .section import Floats, Section
from .stages import Progress, Stages
from .verdict import PROVEN, cut_depth_mm

Sections = dict[str, tuple[Section, Floats | None]]
_AXES = {"x": 0, "y": 1, "z": 2}


def run(
    job_file: str,
    program: str | None,
    *,
    resolution_mm: float,
    planes: Sequence[str] = (),
    probe_radius_mm: float | None = None,
    box: Sequence[float] | None = None,
    mesh: str | None = "machined.stl",
    machine: str | None = None,
    post: str | None = None,
    threads: int = 0,
    on_progress: Progress | None = None,
) -> tuple[bool, str, dict[str, bytes | str]]:
    """Whether no gouge is deeper than the job's tolerances allow, the report, and the files by name.

    planes: "x=…", "y=…", "z=…" in the part's frame. Raises InputError for what cannot be read."""
    if mesh is not None:
        mesh_file.writer(mesh)
    wanted = [parse_plane(plane) for plane in planes]
    spec = job.load(job_file)
    scene, path = _scene_and_path(spec, program, machine, post, on_progress, threads)
    corners = None if box is None else (list(box[:3]), list(box[3:]))
    with blame("--resolution-mm, --box:"):
        found = cutting.cut(
            scene,
            path,
            resolution_mm,
            box=corners,
            with_stock=mesh is not None,
            on_progress=on_progress,
            threads=threads,
        )
    sections = _sections(found, wanted, probe_radius_mm)
    facts = cut_report.facts(found, sections, getattr(path, "block", None))
    title = f"{PurePath(spec.part.file).name}, {PurePath(program or job_file).name}"
    good = facts["worst_gouge"]["deviation_mm"] >= -cut_depth_mm(spec.tolerance, PROVEN)
    return good, cut_report.text(facts), _files(found, facts, sections, mesh, title)


def parse_plane(text: str) -> tuple[str, list[float], list[float]]:
    """ "y=27" → its name, origin and normal."""
    letter, _, value = text.partition("=")
    try:
        at = float(value)
    except ValueError:
        at = float("nan")
    if letter not in ("x", "y") or not np.isfinite(at):
        raise InputError(f"--section: must be x=… or y=… with a number of mm, got '{text}'")
    origin, normal = [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]
    origin[_AXES[letter]], normal[_AXES[letter]] = at, 1.0
    return f"{letter}{at:g}", origin, normal


def _scene_and_path(
    spec: Job,
    program: str | None,
    machine: str | None,
    post: str | None,
    on_progress: Progress | None,
    threads: int,
) -> tuple[Scene, cutting.Moves]:
    if program is None:
        plan = planning.plan(spec, on_progress=on_progress, threads=threads)
        return plan.scene, plan.path
    scene = planning.prepare(spec, None, Stages(on_progress, threads=threads))
    if PurePath(program).suffix.lower() == ".csv":
        return scene, cl_file.read_csv(program)
    moves = read_program(program, machine or spec.machine.name, post)
    frame = scene.frame
    return scene, ProgramMoves(
        moves.kind, frame.to_part(moves.tip), frame.direction_to_part(moves.axis), moves.block
    )


def _sections(
    found: cutting.Cut, wanted: Sequence[tuple[str, list[float], list[float]]], probe_radius_mm: float | None
) -> Sections:
    result: Sections = {}
    for name, origin, normal in wanted:
        with blame(f"--section {name}:"):
            one = found.section(origin, normal)
            result[name] = one, None if probe_radius_mm is None else found.probed(one, probe_radius_mm)
    return result


def _files(
    found: cutting.Cut, facts: Mapping[str, Any], sections: Sections, mesh: str | None, title: str
) -> dict[str, bytes | str]:
    files: dict[str, bytes | str] = {
        "cut.json": cut_report.to_json(dict(facts)),
        "cut.txt": cut_report.text(dict(facts)),
        "deviation.png": cut_picture.deviation_png(found, title),
    }
    for name, (one, by_probe) in sections.items():
        files[f"section_{name}.csv"] = one.to_csv()
        files[f"section_{name}.png"] = cut_picture.section_png(one, f"{title}: section {name}", by_probe)
    if mesh is not None:
        vertices, triangles = found.mesh()
        files[mesh] = mesh_file.to_bytes(mesh, vertices, triangles)
    return files
