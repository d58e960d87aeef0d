"""From operations to the program of a machine: joint values, the post's text, the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import FreeCAD
import numpy as np

from ..core import posts
from ..core.base import Floats, InputError, Names, Stages, write_atomically
from ..core.job import Job
from ..core.machine import feeds, move_machine
from ..core.path import ToolPath
from ..core.posts import ProgramTool
from ..core.program import ProgramPart, Shop, find_shop, make_program
from . import cl_path, compat, three_axis
from .job_spec import job_of, post_of
from .messages import property_names
from .operation import is_operation
from .post_arguments import PostArguments, parse

NO_POSITION = -1
# CAM's words for coolant -> the core's.
COOLANT = {"None": "off", "Flood": "flood", "Mist": "mist"}


@dataclass(frozen=True)
class ProgramText:
    """A program that was read back; with warnings it may be written, but should not be run unread."""

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


@property_names()
def program_text(ops: Sequence[Any], post: str, arguments: str = "") -> ProgramText:
    """The program of operations of one job, one after the other: ours, and CAM's own three-axis ones between them.
    Machine and set-up are those of the first of ours; arguments: of the post, as post_arguments.py has them.

    It is read back and compared with the path before it is returned; what differs is among the warnings."""
    ours = [op for op in ops if is_operation(op)]
    if not ours:
        raise InputError("there is no active Multi-Point Finish operation to write a program for")
    for op in ops:
        check_ready(op)
        _check_machine(ours[0], op)
    job = _job(ours[0], post, parse(arguments))
    shop = find_shop(job)
    parts = [_part(job, shop, group) for group in _groups(ops)]
    made = make_program(job, shop, parts, Stages(), job.post.program_name)
    warnings = [f"{op.Label}: {op.Verdict}" for op in ours if not op.Good]
    warnings += [f"{ours[0].Machine}: {trouble}" for trouble in made.troubles]
    return ProgramText(made.program.text, made.program.file_name, warnings)


def check_ready(op: Any) -> None:
    """Raise InputError unless the operation has an up-to-date path and a tool controller that can run it."""
    if is_operation(op) and (op.Problem or not op.MoveStatus):
        raise InputError(f"{op.Label}: there is no up-to-date path: {op.Problem or 'recompute it first'}")
    if op.ToolController.HorizFeed.Value <= 0 or op.ToolController.VertFeed.Value <= 0:
        raise InputError(f"{op.ToolController.Label}: the horizontal and vertical feed must be positive")
    if op.ToolController.SpindleSpeed <= 0 or op.ToolController.SpindleDir != "Forward":
        raise InputError(
            f"{op.ToolController.Label}: the spindle must turn forward, its speed must be positive"
        )


def _check_machine(first: Any, op: Any) -> None:
    if is_operation(op) and op.Machine != first.Machine:
        raise InputError(
            f"{op.Label}: must have the machine of {first.Label}, {first.Machine}; it has {op.Machine}"
        )


def _job(op: Any, post: str, arguments: PostArguments) -> Job:
    job = job_of(op, (), ())
    return replace(job, post=replace(job.post, name=post, tcp=arguments.tcp, options=arguments.options))


def _groups(ops: Sequence[Any]) -> list[list[Any]]:
    """Operations that follow each other without a retract to the machine's own height: ours with one tool and
    coolant."""
    groups: list[list[Any]] = []
    for op in ops:
        before = groups[-1][0] if groups else None
        if before is not None and is_operation(op) and is_operation(before) and _same_tool(before, op):
            groups[-1].append(op)
        else:
            groups.append([op])
    return groups


def _same_tool(a: Any, b: Any) -> bool:
    return a.ToolController == b.ToolController and a.CoolantMode == b.CoolantMode


def _part(job: Job, shop: Shop, ops: Sequence[Any]) -> ProgramPart:
    """What is written with one tool."""
    op = ops[0]
    path, feed_mm_per_min = _path(ops) if is_operation(op) else _upright_path(op)
    controller = op.ToolController
    return ProgramPart(
        path,
        move_machine(job, shop.machine, path, feed_mm_per_min),
        _box(op),
        tool=ProgramTool(controller.ToolNumber, *compat.radii_of(controller.Tool)),
        spindle_rpm=float(controller.SpindleSpeed),
        coolant=COOLANT[getattr(op, "CoolantMode", "None")],
    )


def path_of(ops: Sequence[Any]) -> ToolPath:
    """The stored moves of our operations as the core's path, in their order."""
    return _path(ops)[0]


def _path(ops: Sequence[Any]) -> tuple[ToolPath, Floats]:
    """The stored moves of our operations, in their order, as the core's path, and their feeds."""
    moves = [cl_path.from_commands(op.Path.Commands) for op in ops]
    joined = {name: np.concatenate([getattr(one, name) for one in moves]) for name in ("kind", "tip", "axis")}
    feed_mm_per_min = np.concatenate([feeds(post_of(op), np.array(one.kind)) for op, one in zip(ops, moves)])
    return _as_path(**joined), feed_mm_per_min


def _upright_path(op: Any) -> tuple[ToolPath, Floats]:
    """The moves of one of CAM's own operations, and their feeds."""
    moves = three_axis.moves_of(op.Label, op.Path.Commands)
    return _as_path(moves.kind, moves.tip, moves.axis), moves.feed_mm_per_min


def _as_path(kind: Names, tip: Floats, axis: Floats) -> ToolPath:
    count = len(kind)
    return ToolPath(
        kind=kind,
        tip=tip,
        axis=axis,
        position=np.full(count, NO_POSITION),
        pass_index=np.zeros(count, dtype=np.int64),
        clearance=np.full(count, np.nan),
        blocked=np.zeros(count, dtype=bool),
        proven=np.zeros(count, dtype=bool),
    )


def _box(op: Any) -> tuple[Floats, Floats]:
    """Low and high corner of the job's stock."""
    box = compat.utils.findParentJob(op).Stock.Shape.BoundBox
    return np.array([box.XMin, box.YMin, box.ZMin]), np.array([box.XMax, box.YMax, box.ZMax])


def warn(result: ProgramText) -> None:
    """Put the warnings into FreeCAD's report view."""
    for line in result.warnings:
        FreeCAD.Console.PrintWarning(f"{line}\n")
