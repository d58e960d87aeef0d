"""From operations to the program of a machine: joint values, the post's text, the file."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import FreeCAD
import numpy as np

from ..core import machines, posts
from ..core.errors import InputError, blame
from ..core.machine_path import MachinePath, axis_tolerance_deg, machine_path
from ..core.output import write_atomically
from ..core.posts.program import Program, ProgramTool, program_name
from . import cl_path, compat
from .job_spec import tool_of


@dataclass(frozen=True)
class ProgramText:
    text: str  # with the line ends that the control expects
    file_ending: str  # with its dot
    warnings: list[str]  # what the reader must know although it does not keep the program from being written


def write(op: Any, path: str) -> ProgramText:
    """Write the program of one operation, with its own post, to `path`: whole or not at all.

    Raises InputError when there is no up-to-date path, or the machine, the post or the file cannot take it."""
    result = program_text([op], op.Post)
    write_atomically(path, result.text)
    return result


def default_name(op: Any) -> str:
    """A file name for the operation's program, with the post's ending."""
    return program_name(op.Label) + posts.load(op.Post).file_ending


def program_text(ops: Sequence[Any], post: str) -> ProgramText:
    """The program of operations that share job, tool controller and machine, one after the other."""
    if not ops:
        raise InputError("there is no active Multi-Point Finish operation to write a program for")
    first = ops[0]
    for op in ops:
        _check_ready(op)
        _check_same(first, op)
    moves = _machine_path(ops)
    program = Program(
        name=program_name(first.Label),
        machine=machines.load(first.Machine),
        tool=_program_tool(first),
        spindle_rpm=float(first.ToolController.SpindleSpeed),
        moves=moves,
        coolant=first.CoolantMode != "None",
        blank=_blank(first),
    )
    writer = posts.load(post)
    with blame(f"{first.Label}:"):
        return ProgramText(writer.write(program), writer.file_ending, _warnings(ops, moves))


def _check_ready(op: Any) -> None:
    if op.Problem:
        raise InputError(f"{op.Label}: there is no up-to-date path: {op.Problem}")
    if op.ToolController.HorizFeed.Value <= 0 or op.ToolController.VertFeed.Value <= 0:
        raise InputError(f"{op.ToolController.Label}: the horizontal and vertical feed must be positive")
    if op.ToolController.SpindleSpeed <= 0:
        raise InputError(f"{op.ToolController.Label}: the spindle speed must be positive")


def _check_same(first: Any, op: Any) -> None:
    if op.ToolController != first.ToolController:
        raise InputError(f"{op.Label}: must have the tool controller of {first.Label}, or the output must be split by tool")
    if op.Machine != first.Machine:
        raise InputError(f"{op.Label}: must have the machine of {first.Label}, {first.Machine}; it has {op.Machine}")


def _machine_path(ops: Sequence[Any]) -> MachinePath:
    moves = [cl_path.from_commands(op.Path.Commands) for op in ops]
    tolerance = min(axis_tolerance_deg(op.ChordTolerance.Value, tool_of(op).radius_mm) for op in ops)
    with blame(f"{ops[0].Label}:"):
        return machine_path(
            machines.load(ops[0].Machine),
            np.concatenate([np.array(one.kind) for one in moves]),
            np.concatenate([one.tip for one in moves]),
            np.concatenate([one.axis for one in moves]),
            np.concatenate([one.feed_mm_per_min for one in moves]),
            axis_tolerance_deg=tolerance,
        )


def _program_tool(op: Any) -> ProgramTool:
    tool = tool_of(op)
    return ProgramTool(op.ToolController.ToolNumber, tool.radius_mm, tool.minor_radius_mm)


def _blank(op: Any) -> tuple[np.ndarray, np.ndarray] | None:
    """Corners of the job's stock."""
    job = compat.utils.findParentJob(op)
    if job is None or job.Stock is None or job.Stock.Shape.isNull():
        return None
    box = job.Stock.Shape.BoundBox
    return np.array([box.XMin, box.YMin, box.ZMin]), np.array([box.XMax, box.YMax, box.ZMax])


def _warnings(ops: Sequence[Any], moves: MachinePath) -> list[str]:
    verdicts = [f"{op.Label}: {op.Verdict}" for op in ops if not op.Good]
    return verdicts + [f"{ops[0].Machine}: {trouble}" for trouble in moves.troubles()]


def warn(result: ProgramText) -> None:
    """Put the warnings into FreeCAD's report view."""
    for line in result.warnings:
        FreeCAD.Console.PrintWarning(f"{line}\n")
