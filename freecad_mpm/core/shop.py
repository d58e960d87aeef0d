"""Machine and post of a job: from the path to the machine's joints and the program."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from . import dialects, machines, posts, program_report
from .control import Control
from .errors import blame
from .job import Job, PostSpec
from .kinematics import datum_mm
from .machine_path import MachinePath, machine_path
from .machines import Machine
from .motions import control_deviation_deg, control_tip_deviation_mm
from .plan import Floats, Names, Path, ProgramFile
from .posts.options import PostOptions
from .posts.program import PROGRAM_NAME, Program, ProgramTool, program_name
from .program_check import CheckResult, check_program
from .program_report import ProgramReport
from .stages import Stages

FILE_STEM = "program"
# What rounding to the words' decimals may add to the allowances between two blocks.
WORD_SLACK = 1.05


@dataclass(frozen=True)
class Shop:
    """The machine that is to run the job, and the post that writes for its control."""

    machine: Machine
    post: posts.Post
    options: PostOptions


def find_shop(job: Job) -> Shop:
    """Raises InputError for a machine or post that there is not, for what the post does not write, and for a program
    name that controls do not take."""
    with blame(f"{job.source}: [{job.machine.table}] name:"):
        machine = machines.load(job.machine.name)
    with blame(f"{job.source}: [{job.post.table}] name:"):
        post = posts.load(job.post.name)
    with blame(f"{job.source}:"):
        options = post.options(job.post.options)
    if not (job.post.tcp or post.joints):
        raise job.error(
            PostSpec.table, "tcp", f"must be true, the post {post.name} writes no joint positions"
        )
    name = job.post.program_name
    if not PROGRAM_NAME.fullmatch(name):
        right = f"must be {PROGRAM_NAME.pattern}, such as {program_name(name)}"
        raise job.error(PostSpec.table, "program_name", f"{right}, got '{name}'")
    return Shop(machine, post, options)


@dataclass(frozen=True)
class Made:
    """What the shop made of a path. `path` and `joints` are in the set-up frame."""

    path: Path
    joints: MachinePath
    program: ProgramFile
    report: ProgramReport

    @property
    def troubles(self) -> list[str]:
        """One line for each kind of thing that the machine cannot do, or that is wrong with the program."""
        return self.joints.troubles(self.path.position) or told(self.report.findings)


def told(findings: Sequence[object]) -> list[str]:
    """One line for all findings of a program's checks, or none."""
    if not findings:
        return []
    return [f"{len(findings)} findings of the program's checks, the first: {findings[0]}"]


def make_program(
    job: Job, shop: Shop, path: Path, joints: MachinePath, box: tuple[Floats, Floats], stages: Stages
) -> Made:
    """The program, and its text read back and checked; path, joints and the part's `box` in the set-up frame."""
    program = describe(job, shop, joints, box)
    with blame(f"{job.source}: [{job.post.table}]"):
        text = stages.run("program", shop.post.write, program)
    checked = stages.run("check", check_text, text, job, program, path, shop.post.dialect)
    return Made(path, joints, ProgramFile(FILE_STEM + shop.post.file_ending, text), checked)


def move_machine(job: Job, shop: Shop, path: Path, feed_mm_per_min: Floats | None = None) -> MachinePath:
    """The machine's joints along a path in the set-up frame, with the moves that keep the chord tolerance; feeds (M,) of
    the moves: None takes the job's."""
    return machine_path(
        shop.machine,
        path.kind,
        path.tip,
        path.axis,
        feeds(job.post, path.kind) if feed_mm_per_min is None else feed_mm_per_min,
        axis_tolerance_deg=control_deviation_deg(job),
        tip_tolerance_mm=None if job.post.tcp else control_tip_deviation_mm(job),
    )


def feeds(post: PostSpec, kind: Names) -> Floats:
    """(M,) feeds of moves of these kinds, mm/min."""
    return np.where(np.isin(kind, ("cut", "link")), post.cut_feed_mm_per_min, post.plunge_feed_mm_per_min)


def describe(job: Job, shop: Shop, joints: MachinePath, box: tuple[Floats, Floats]) -> Program:
    """What the post writes from; `box`: low and high corner of the part in the set-up frame."""
    return Program(
        name=job.post.program_name,
        machine=shop.machine,
        tool=ProgramTool(job.post.tool_number, job.tool.radius_mm, job.tool.minor_radius_mm),
        spindle_rpm=job.post.spindle_rpm,
        moves=joints,
        blank=box,
        axes_mm=None if job.post.tcp else axes_of(shop.machine, joints),
        options=shop.options,
    )


def axes_of(machine: Machine, joints: MachinePath) -> Floats:
    """(M, 3) X, Y and Z as a control without tool-centre-point control counts them."""
    setup = machine.setup
    return joints.linear_mm - datum_mm(machine, np.array(setup.part_origin_mm), setup.tool_length_mm)


def check_text(text: str, job: Job, program: Program, path: Path, dialect: str) -> ProgramReport:
    """Read the program's text back as a control would, and compare its poses with the path's."""
    blocks, checks = read_back(text, job, program.machine, path.tip, path.axis, dialect)
    return program_report.report(program, blocks, checks)


def read_back(
    text: str, job: Job, machine: Machine, tip: Floats, axis: Floats, dialect: str
) -> tuple[int, CheckResult]:
    """How many blocks a text has, and what all checks say of it; tip, axis (N, 3): the poses that it must meet."""
    parsed = dialects.read(text, dialect)
    between = WORD_SLACK * control_tip_deviation_mm(job), WORD_SLACK * control_deviation_deg(job)
    control = Control(job.post.tcp, between_mm=between[0], between_deg=between[1])
    return len(parsed.blocks), check_program(parsed, machine, tip, axis, control)
