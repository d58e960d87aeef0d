"""The command `cut`: a job's plan, a CL file or a program's text, cut into the stock and measured."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import PurePath
from typing import Any

from . import (
    cl_file,
    cut_memory,
    cut_report,
    cutting,
    deviation_bands,
    deviation_picture,
    job,
    mesh_file,
    plane_curve,
    planes,
    planning,
    section_picture,
)
from .errors import blame
from .job import Job
from .model import Scene
from .plane_curve import Curve
from .program_moves import ProgramMoves, read_program
from .section import Floats, Section
from .stages import Progress, Stages
from .swept import Moves
from .verdict import PROVEN, cut_depth_mm

Sections = dict[str, tuple[Section, Floats | None]]


def run(
    job_file: str,
    program: str | None,
    *,
    resolution_mm: float,
    sections: Sequence[str] = (),
    probe_radius_mm: float | None = None,
    box: Sequence[float] | None = None,
    mesh: str | None = "machined.stl",
    machine: str | None = None,
    post: str | None = None,
    threads: int = 0,
    on_progress: Progress | None = None,
    say: Callable[[str], None] = print,
) -> tuple[bool, str, dict[str, bytes | str]]:
    """Whether no gouge is deeper than the job's tolerances allow, the report, and the files by name.

    sections: planes as `planes.FORMS` has them. say: gets a line on the memory it takes before the work begins. Raises
    InputError, before any long work, for what cannot be read, planes that miss the faces, and too little memory.
    """
    if mesh is not None:
        mesh_file.writer(mesh)
    wanted = [planes.parse(text) for text in sections]
    spec = job.load(job_file)
    scene = planning.prepare(spec, None, Stages(on_progress, threads=threads))
    corners = None if box is None else (list(box[:3]), list(box[3:]))
    curves = {plane.name: _curve(scene, plane) for plane in wanted}
    with blame("--resolution-mm, --box:"):
        say(cut_memory.check(scene, resolution_mm, corners, with_stock=mesh is not None))
    path = _path(spec, scene, program, machine, post, on_progress, threads)
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
    measured = {name: _measured(found, one, probe_radius_mm) for name, one in curves.items()}
    facts = cut_report.facts(found, measured, getattr(path, "block", None))
    title = f"{PurePath(spec.part.file).name}, {PurePath(program or job_file).name}"
    depth = cut_depth_mm(spec.tolerance, PROVEN)
    files = _files(found, facts, measured, mesh, title, depth)
    return found.good(depth), cut_report.text(facts), files


def _curve(scene: Scene, plane: planes.NamedPlane) -> Curve:
    with blame(f"--section {plane.name}:"):
        return plane_curve.curve(scene, plane.origin, plane.normal, cutting.SECTION_SPACING_MM)


def _path(
    spec: Job,
    scene: Scene,
    program: str | None,
    machine: str | None,
    post: str | None,
    on_progress: Progress | None,
    threads: int,
) -> Moves:
    if program is None:
        faces = [*scene.machined, *scene.check]
        return planning.plan(spec, faces, on_progress=on_progress, threads=threads).path
    if PurePath(program).suffix.lower() == ".csv":
        return cl_file.read_csv(program)
    moves = read_program(program, machine or spec.machine.name, post)
    frame = scene.frame
    return ProgramMoves(
        moves.kind, frame.to_part(moves.tip), frame.direction_to_part(moves.axis), moves.block
    )


def _measured(found: cutting.Cut, one: Curve, probe_radius_mm: float | None) -> tuple[Section, Floats | None]:
    section = found.along(one)
    return section, None if probe_radius_mm is None else found.probed(section, probe_radius_mm)


def _files(
    found: cutting.Cut,
    facts: Mapping[str, Any],
    sections: Sections,
    mesh: str | None,
    title: str,
    depth_mm: float,
) -> dict[str, bytes | str]:
    files: dict[str, bytes | str] = {
        "cut.json": cut_report.to_json(dict(facts)),
        "cut.txt": cut_report.text(dict(facts)),
        "deviation.png": deviation_picture.render(
            deviation_picture.map_of(found), deviation_bands.bands(depth_mm), title
        ),
    }
    for name, (one, by_probe) in sections.items():
        files[f"section_{name}.csv"] = one.to_csv()
        files[f"section_{name}.png"] = section_picture.render(one, f"{title}: section {name}", by_probe)
    if mesh is not None:
        vertices, triangles = found.mesh()
        files[mesh] = mesh_file.to_bytes(mesh, vertices, triangles)
    return files
