"""Machine and post of a job: from the path to the machine's joints and the program."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from .. import machine as machines
from .. import posts
from ..base import Floats, Stages, blame
from ..control import CheckResult, Control, check_program, dialects
from ..job import WORD_SLACK, Job, PostSpec, control_deviation_deg, control_tip_deviation_mm
from ..machine import JointPath, Machine, axes_of
from ..path import ToolPath
from ..posts import PROGRAM_NAME, PostOptions, Program, ProgramTool, program_name
from . import report
from .report import ProgramReport

FILE_STEM = "program"


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

    path: ToolPath
    joints: JointPath
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
    job: Job, shop: Shop, path: ToolPath, joints: JointPath, box: tuple[Floats, Floats], stages: Stages
) -> Made:
    """The program, and its text read back and checked; path, joints and the part's `box` in the set-up frame."""
    program = describe(job, shop, joints, box)
    with blame(f"{job.source}: [{job.post.table}]"):
        text = stages.run("program", shop.post.write, program)
    checked = stages.run("check", check_text, text, job, program, path, shop.post.dialect)
    return Made(path, joints, ProgramFile(FILE_STEM + shop.post.file_ending, text), checked)


def describe(job: Job, shop: Shop, joints: JointPath, box: tuple[Floats, Floats]) -> Program:
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


def check_text(text: str, job: Job, program: Program, path: ToolPath, dialect: str) -> ProgramReport:
    """Read the program's text back as a control would, and compare its poses with the path's."""
    blocks, checks = read_back(text, job, program.machine, path.tip, path.axis, dialect)
    return report.report(program, blocks, checks)


def read_back(
    text: str, job: Job, machine: Machine, tip: Floats, axis: Floats, dialect: str
) -> tuple[int, CheckResult]:
    """How many blocks a text has, and what all checks say of it; tip, axis (N, 3): the poses that it must meet."""
    parsed = dialects.read(text, dialect)
    between = WORD_SLACK * control_tip_deviation_mm(job), WORD_SLACK * control_deviation_deg(job)
    control = Control(job.post.tcp, between_mm=between[0], between_deg=between[1])
    return len(parsed.blocks), check_program(parsed, machine, tip, axis, control)


@dataclass(frozen=True)
class ProgramFile:
    """The post's text and the file name it belongs under."""

    file_name: str
    text: str
