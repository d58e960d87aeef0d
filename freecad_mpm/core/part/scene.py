"""From the part's faces to the native surface model: which faces, in which frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from ... import _core
from ..base import Stages, blame
from ..job import Job, Part, ToolSpec
from .faces import FaceArrays, to_core
from .file import read_part
from .frame import Frame, frame_of

# So many names are listed one by one in a message; of more, the first and the last.
LISTED_NAMES = 12


@dataclass(frozen=True)
class Scene:
    """What the stages work on: the faces in the part's frame; model and tool in the set-up frame."""

    frame: Frame
    machined: Sequence[FaceArrays]
    check: Sequence[FaceArrays]
    model: _core.SurfaceModel
    tool: _core.Tool

    @cached_property
    def cells(self) -> _core.CellTree:
        """What all proofs about this model and tool work on; made when it is first asked for."""
        return _core.CellTree(self.model, self.tool)


def build_scene(job: Job, faces: Sequence[FaceArrays]) -> Scene:
    """The scene of a job's part, whose `faces` are in the part's frame."""
    machined, check = machined_and_check(job, faces)
    frame = frame_of(job.setup)
    with blame(f"{job.label}:"):
        return Scene(frame, machined, check, surface_model(machined, check, frame), native_tool(job.tool))


def machined_and_check(job: Job, faces: Sequence[FaceArrays]) -> tuple[list[FaceArrays], list[FaceArrays]]:
    """The faces to machine and those to keep clear of, as the job names them.

    Raises InputError for a name that is no face's, or that is in both lists."""
    part = job.part
    machined = _named(job, faces, "faces", part.faces or [face.name for face in faces])
    others = [face.name for face in faces if face.name not in part.faces] if part.faces else []
    check = _named(job, faces, "check_faces", part.check_faces or others)
    both = {face.name for face in machined} & {face.name for face in check}
    if both:
        raise job.error(
            Part.table, "check_faces", f"must not name a face to machine, got {', '.join(sorted(both))}"
        )
    return machined, check


def _named(job: Job, faces: Sequence[FaceArrays], key: str, names: Sequence[str]) -> list[FaceArrays]:
    known = {face.name: face for face in faces}
    for name in names:
        if name not in known:
            there_are = f"no such face in {job.part.file or 'the part'}; there are {listing(list(known))}"
            raise job.error(Part.table, key, f"'{name}': {there_are}")
    return [known[name] for name in dict.fromkeys(names)]


def listing(names: Sequence[str]) -> str:
    """Names for a message, shortened when there are many."""
    if len(names) <= LISTED_NAMES:
        return ", ".join(names)
    return f"{names[0]} to {names[-1]} ({len(names)} faces)"


def surface_model(
    machined: Sequence[FaceArrays], check: Sequence[FaceArrays], frame: Frame
) -> _core.SurfaceModel:
    """The native model of all faces in the set-up frame."""
    native = [to_core(face.transformed(frame)) for face in machined]
    return _core.SurfaceModel(native + [to_core(face.transformed(frame), check=True) for face in check])


def native_tool(tool: ToolSpec) -> _core.Tool:
    """The native cutter with shank and holder."""
    segments = [
        (one.bottom_radius_mm, one.top_radius_mm, one.length_mm) for one in (*tool.shank, *tool.holder)
    ]
    with blame(f"[{tool.table}]"):
        return _core.Tool(
            tool.major_radius_mm, tool.minor_radius_mm, tool.recess_mm, tool.flute_length_mm, segments
        )


def prepare(job: Job, faces: Sequence[FaceArrays] | None, stages: Stages) -> Scene:
    """Read the part unless its faces are given, and build the native model and tool.

    Trim polygons may be off by the gouge tolerance: a border that they cut short is a gouge nobody sees."""
    if faces is None:
        with blame(f"{job.label}: [{job.part.table}] file:"):
            faces = stages.run("read", read_part, job.part.file, job.tolerance.gouge_mm)
    return stages.run("model", build_scene, job, faces)
