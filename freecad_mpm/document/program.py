"""From operations to the program of a machine: joint values, the post's text, the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import FreeCAD
import numpy as np

from ..core import posts, shop
from ..core.errors import InputError
from ..core.output import write_atomically
from ..core.plan import Path, ProgramFile
from . import cl_path, compat
from .job_spec import job_of, post_of

NO_POSITION = -1
# CAM's words for coolant -> the core's.
COOLANT = {"None": "off", "Flood": "flood", "Mist": "mist"}


@dataclass(frozen=True)
class ProgramText:
    text: str  # with the line ends that the control expects
    file_name: str  # with the ending that the control expects
    warnings: list[str]  # what the reader must know although it does not keep the program from being written


def write(op: Any, path: str) -> ProgramText:
    """Write the program of one operation, with its own post, to `path`: whole or not at all.

    Raises InputError when there is no up-to-date path, or the machine, the post or the file cannot take it.
    """
    result = program_text([op], op.Post)
    write_atomically(path, result.text)
    return result


def default_name(op: Any) -> str:
    """A file name for the operation's program, with the post's ending."""
    return post_of(op).program_name + posts.load(op.Post).file_ending


def program_text(ops: Sequence[Any], post: str) -> ProgramText:
    """The program of operations that share job, tool controller and machine, one after the other.

    It is read back and compared with the path before it is returned; what differs is among the warnings."""
    if not ops:
        raise InputError("there is no active Multi-Point Finish operation to write a program for")
    first = ops[0]
    for op in ops:
        _check_ready(op)
        _check_same(first, op)
    made = _make(first, post, _path(ops))
    warnings = [f"{op.Label}: {op.Verdict}" for op in ops if not op.Good]
    warnings += [f"{first.Machine}: {trouble}" for trouble in made.troubles]
    return ProgramText(made.program.text, made.program.file_name, warnings)


def _check_ready(op: Any) -> None:
    if op.Problem or not op.MoveStatus:
        raise InputError(f"{op.Label}: there is no up-to-date path: {op.Problem or 'recompute it first'}")
    if op.ToolController.HorizFeed.Value <= 0 or op.ToolController.VertFeed.Value <= 0:
        raise InputError(f"{op.ToolController.Label}: the horizontal and vertical feed must be positive")
    if op.ToolController.SpindleSpeed <= 0:
        raise InputError(f"{op.ToolController.Label}: the spindle speed must be positive")


def _check_same(first: Any, op: Any) -> None:
    if op.ToolController != first.ToolController:
        raise InputError(
            f"{op.Label}: must have the tool controller of {first.Label}: a program has one tool"
        )
    if op.Machine != first.Machine:
        raise InputError(
            f"{op.Label}: must have the machine of {first.Label}, {first.Machine}; it has {op.Machine}"
        )


def _make(op: Any, post: str, path: Path) -> shop.Made:
    """What the core's shop makes of a path with the settings of `op`, which alone knows of coolant."""
    job = job_of(op, (), ())
    job = replace(job, post=replace(job.post, name=post))
    place = shop.find_shop(job)
    joints = shop.move_machine(job, place, path)
    program = shop.describe(job, place, joints, _box(op))
    coolant = COOLANT[op.CoolantMode]
    program = replace(program, options=replace(program.options, coolant=coolant))
    text = place.post.write(program)
    file = ProgramFile(program.name + place.post.file_ending, text)
    return shop.Made(path, joints, file, shop.check_text(text, job, program, path, place.post.dialect))


def _path(ops: Sequence[Any]) -> Path:
    """The stored moves of all operations as the core's path, in their order."""
    moves = [cl_path.from_commands(op.Path.Commands) for op in ops]
    kind = np.concatenate([one.kind for one in moves])
    return Path(
        kind=kind,
        tip=np.concatenate([one.tip for one in moves]),
        axis=np.concatenate([one.axis for one in moves]),
        position=np.full(len(kind), NO_POSITION),
        pass_index=np.concatenate([one.pass_index for one in moves]),
        clearance=np.full(len(kind), np.nan),
        blocked=np.zeros(len(kind), dtype=bool),
    )


def _box(op: Any) -> tuple[np.ndarray, np.ndarray]:
    """Low and high corner of the job's stock."""
    box = compat.utils.findParentJob(op).Stock.Shape.BoundBox
    return np.array([box.XMin, box.YMin, box.ZMin]), np.array([box.XMax, box.YMax, box.ZMax])


def warn(result: ProgramText) -> None:
    """Put the warnings into FreeCAD's report view."""
    for line in result.warnings:
        FreeCAD.Console.PrintWarning(f"{line}\n")
