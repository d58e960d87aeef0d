"""Machine and post of a job: from the path to the machine's joints and the program."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import machines, posts
from .errors import blame
from .job import Job, PostSpec
from .machine_path import MachinePath, axis_tolerance_deg, machine_path
from .machines import Machine
from .plan import Floats, Names, Path, ProgramFile
from .posts.program import PROGRAM_NAME, Program, ProgramTool, program_name

FILE_STEM = "program"


@dataclass(frozen=True)
class Shop:
    """The machine that is to run the job, and the post that writes for its control."""

    machine: Machine
    post: posts.Post


def find_shop(job: Job) -> Shop:
    """Raises InputError for a machine or post that there is not, and a program name that controls do not take."""
    with blame(f"{job.source}: [{job.machine.table}] name:"):
        machine = machines.load(job.machine.name)
    with blame(f"{job.source}: [{job.post.table}] name:"):
        post = posts.load(job.post.name)
    name = job.post.program_name
    if not PROGRAM_NAME.fullmatch(name):
        right = f"must be {PROGRAM_NAME.pattern}, such as {program_name(name)}"
        raise job.error(PostSpec.table, "program_name", f"{right}, got '{name}'")
    return Shop(machine, post)


def move_machine(job: Job, shop: Shop, path: Path) -> MachinePath:
    """The machine's joints along a path in the set-up frame, with the moves that keep the chord tolerance."""
    return machine_path(
        shop.machine,
        path.kind,
        path.tip,
        path.axis,
        _feeds(job.post, path.kind),
        axis_tolerance_deg=axis_tolerance_deg(job.tolerance.chord_mm, job.tool.radius_mm),
    )


def _feeds(post: PostSpec, kind: Names) -> Floats:
    return np.where(np.isin(kind, ("cut", "link")), post.cut_feed_mm_per_min, post.plunge_feed_mm_per_min)


def write_program(job: Job, shop: Shop, joints: MachinePath, box: tuple[Floats, Floats]) -> ProgramFile:
    """The program; `box`: low and high corner of the part in the set-up frame."""
    program = Program(
        name=job.post.program_name,
        machine=shop.machine,
        tool=ProgramTool(job.post.tool_number, job.tool.radius_mm, job.tool.minor_radius_mm),
        spindle_rpm=job.post.spindle_rpm,
        moves=joints,
        blank=box,
    )
    with blame(f"{job.source}: [{job.post.table}]"):
        return ProgramFile(FILE_STEM + shop.post.file_ending, shop.post.write(program))
