"""What a plan holds: arrays, one row a position or move, in the part's frame and mm, and the report."""

from __future__ import annotations

from dataclasses import dataclass

from ..base import Flags, Floats, Integers, Names
from ..job import Job
from ..machine import JointPath
from ..part import Scene
from ..path import ToolPath
from ..positioning import Positions
from ..program import ProgramFile
from ..report import Report


@dataclass(frozen=True)
class Plan:
    """A computed job: its positions, the path over them, and what was made of it.

    The columns of the positions go by their short names too: `plan.tip` is `plan.positions.tip`."""

    positions: Positions
    path: ToolPath
    job: Job
    scene: Scene
    joints: JointPath  # set-up frame, with the moves the machine needs in between
    program: ProgramFile
    report: Report

    def __len__(self) -> int:
        return len(self.positions)

    @property
    def tip(self) -> Floats:
        return self.positions.tip

    @property
    def axis(self) -> Floats:
        return self.positions.axis

    @property
    def contacts(self) -> Floats:
        return self.positions.contacts

    @property
    def status(self) -> Names:
        return self.positions.status

    @property
    def clearance(self) -> Floats:
        return self.positions.clearance

    @property
    def pass_index(self) -> Integers:
        return self.positions.pass_index

    @property
    def inserted(self) -> Flags:
        return self.positions.inserted

    @property
    def normals(self) -> Floats:
        return self.positions.normals

    @property
    def tilt_deg(self) -> Floats:
        return self.positions.tilt_deg

    @property
    def spin_deg(self) -> Floats:
        return self.positions.spin_deg

    @property
    def usable(self) -> Flags:
        return self.positions.usable

    @property
    def neighbours(self) -> Flags:
        return self.positions.neighbours
