"""`cut`: cut a plan, a CL file or a program into the stock and measure what is left."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import replace
from pathlib import PurePath

from .. import job, planning, posts, removal
from ..base import Floats, Stages, blame, output
from ..control import read_program
from ..job import PROVEN, Job, cut_depth_mm
from ..part import Scene, prepare
from ..path import cl_file
from ..pictures import deviation
from ..pictures import section as section_picture
from ..removal import (
    Curve,
    CutReport,
    PathMoves,
    Section,
    bands,
    memory,
    mesh_file,
    plane_curve,
    planes,
    probed,
)
from .common import GOOD, NOT_GOOD, Files, add_threads, positive, write
from .console import ProgressLine

Sections = dict[str, tuple[Section, Floats | None]]


def arguments(parser: ArgumentParser) -> None:
    """The job, what is cut instead of its own path, and how finely it is looked at."""
    parser.add_argument("job", metavar="JOB.toml")
    parser.add_argument("program", metavar="PROGRAM|cl.csv", nargs="?", help="default: the job is planned")
    parser.add_argument(
        "--out", metavar="DIR", required=True, help="folder for the results, made when missing"
    )
    parser.add_argument(
        "--resolution-mm",
        metavar="MM",
        type=positive,
        default=0.5,
        help="between dexels and points; default: 0.5",
    )
    parser.add_argument(
        "--box", metavar="MM", type=float, nargs=6, help="only there: lo x y z, hi x y z, set-up frame"
    )
    parser.add_argument(
        "--section",
        metavar="PLANE",
        action="append",
        default=[],
        help=f"{planes.FORMS}, part frame; may be given several times",
    )
    parser.add_argument(
        "--probe-radius-mm", metavar="MM", type=positive, help="measure the sections with such a ball, too"
    )
    parser.add_argument(
        "--mesh", metavar="NAME", default="machined.stl", help="the stock's file: .stl, .ply or .obj"
    )
    parser.add_argument(
        "--machine", metavar="NAME", help="that makes the program's moves; default: the job's"
    )
    parser.add_argument(
        "--post", metavar="NAME", help="whose dialect the program is; default: the one it looks like"
    )
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Raises InputError, before any long work, for what cannot be read, planes that miss the faces, and too little
    memory."""
    output.check_folder(given.out)
    mesh_file.writer(given.mesh)
    wanted = [planes.parse(one) for one in given.section]
    spec = job.load(given.job)
    scene = prepare(spec, None, Stages(progress, threads=given.threads))
    corners = None if given.box is None else (list(given.box[:3]), list(given.box[3:]))
    curves = {plane.name: _curve(scene, plane) for plane in wanted}
    with blame("--resolution-mm, --box:"):
        progress.say(memory.check(scene, given.resolution_mm, corners, with_stock=True))
    path = _path(spec, scene, given, progress)
    with blame("--resolution-mm, --box:"):
        found = removal.cut(
            scene, path, given.resolution_mm, box=corners, on_progress=progress, threads=given.threads
        )
    measured = {name: _measured(found, one, given.probe_radius_mm) for name, one in curves.items()}
    told = CutReport.of(found, measured, getattr(path, "block", None))
    title = f"{PurePath(spec.part.file).name}, {PurePath(given.program or given.job).name}"
    depth = cut_depth_mm(spec.tolerance, PROVEN)
    files = _files(found, told, measured, given.mesh, title, depth)
    progress.clear()
    print(told.text(), end="")
    write(given.out, files)
    return GOOD if found.good(depth) else NOT_GOOD


def _curve(scene: Scene, plane: planes.NamedPlane) -> Curve:
    with blame(f"--section {plane.name}:"):
        return plane_curve.curve(scene, plane.origin, plane.normal, removal.SECTION_SPACING_MM)


def _path(spec: Job, scene: Scene, given: Namespace, progress: ProgressLine) -> PathMoves:
    """The moves to be cut, in the part's frame."""
    if given.program is None:
        faces = [*scene.machined, *scene.check]
        return planning.plan(spec, faces, on_progress=progress, threads=given.threads).path
    if PurePath(given.program).suffix.lower() == ".csv":
        return cl_file.read_csv(given.program)
    dialect = None if given.post is None else posts.load(given.post).dialect
    moves = read_program(given.program, given.machine or spec.machine.name, dialect)
    return replace(moves, tip=scene.frame.to_part(moves.tip), axis=scene.frame.direction_to_part(moves.axis))


def _measured(found: removal.Cut, one: Curve, probe_radius_mm: float | None) -> tuple[Section, Floats | None]:
    section = found.along(one)
    return section, None if probe_radius_mm is None else probed(found, section, probe_radius_mm)


def _files(
    found: removal.Cut,
    told: CutReport,
    sections: Sections,
    mesh: str,
    title: str,
    depth_mm: float,
) -> Files:
    files: Files = {
        "cut.json": told.to_json(),
        "cut.txt": told.text(),
        "deviation.png": deviation.render(deviation.map_of(found), bands.bands(depth_mm), title),
    }
    for name, (one, by_probe) in sections.items():
        files[f"section_{name}.csv"] = one.to_csv()
        files[f"section_{name}.png"] = section_picture.render(one, f"{title}: section {name}", by_probe)
    vertices, triangles = found.mesh()
    files[mesh] = mesh_file.to_bytes(mesh, vertices, triangles)
    return files
