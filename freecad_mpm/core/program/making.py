"""Machine and post of a job, and the program: described, written by its post, read back by the control."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

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
    with blame(f"{job.label}: [{job.machine.table}] name:"):
        machine = machines.load(job.machine.name)
    with blame(f"{job.label}: [{job.post.table}] name:"):
        post = posts.load(job.post.name)
    with blame(f"{job.label}:"):
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
class ProgramPart:
    """What a program does with one tool, all in the set-up frame; what is None is the job's."""

    path: ToolPath
    joints: JointPath
    box: tuple[Floats, Floats]  # low and high corner of the part or stock
    tool: ProgramTool | None = None
    spindle_rpm: float | None = None
    coolant: str | None = None

    def described(self, job: Job, shop: Shop) -> Program:
        """What the post writes from."""
        own = ProgramTool(job.post.tool_number, job.tool.radius_mm, job.tool.minor_radius_mm)
        coolant = self.coolant or shop.options.coolant
        return Program(
            name=job.post.program_name,
            machine=shop.machine,
            tool=self.tool or own,
            spindle_rpm=self.spindle_rpm or job.post.spindle_rpm,
            moves=self.joints,
            blank=self.box,
            axes_mm=None if job.post.tcp else axes_of(shop.machine, self.joints),
            options=replace(shop.options, coolant=coolant),
        )


@dataclass(frozen=True)
class ProgramFile:
    """The post's text, with the line ends that the control expects, and the file name it belongs under."""

    file_name: str
    text: str


@dataclass(frozen=True)
class Made:
    """A program, and what reading its text back brought to light."""

    parts: Sequence[ProgramPart]
    programs: Sequence[Program]
    program: ProgramFile
    blocks: int
    checks: CheckResult

    @property
    def troubles(self) -> list[str]:
        """One line for each kind of thing that the machine cannot do, or else one for what is wrong with the text."""
        found = [trouble for one in self.parts for trouble in one.joints.troubles(one.path.position)]
        findings = self.checks.findings
        if findings and not found:
            found = [f"{len(findings)} findings of the program's checks, the first: {findings[0]}"]
        return found

    @cached_property
    def report(self) -> ProgramReport:
        """Figures of a program of one part."""
        (program,) = self.programs
        return report.report(program, self.blocks, self.checks)


def make_program(
    job: Job, shop: Shop, parts: Sequence[ProgramPart], stages: Stages, stem: str = FILE_STEM
) -> Made:
    """The program of a job, part by part with its tools; its text is read back as a control would and compared with
    the poses of the parts' paths. stem: of the file name.

    Raises InputError for what the post cannot write."""
    programs = [part.described(job, shop) for part in parts]
    with job.blamed(job.post.table):
        text = stages.run("program", shop.post.write, *programs)
    blocks, checks = stages.run("check", _read_back, text, job, shop, parts)
    return Made(parts, programs, ProgramFile(stem + shop.post.file_ending, text), blocks, checks)


def _read_back(text: str, job: Job, shop: Shop, parts: Sequence[ProgramPart]) -> tuple[int, CheckResult]:
    """How many blocks a text has, and what all checks say of it."""
    tip, axis = (np.concatenate([getattr(part.path, name) for part in parts]) for name in ("tip", "axis"))
    parsed = dialects.read(text, shop.post.dialect)
    between = WORD_SLACK * control_tip_deviation_mm(job), WORD_SLACK * control_deviation_deg(job)
    control = Control(job.post.tcp, between_mm=between[0], between_deg=between[1])
    return len(parsed.blocks), check_program(parsed, shop.machine, tip, axis, control)
