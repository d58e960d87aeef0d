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
        """(N, 3) mm, part frame; NaN: no pose was found."""
        return self.positions.tip

    @property
    def axis(self) -> Floats:
        """(N, 3) unit, part frame, from the tip to the spindle."""
        return self.positions.axis

    @property
    def contacts(self) -> Floats:
        """(N, 2, 3) mm, part frame: first and second contact; NaN: none."""
        return self.positions.contacts

    @property
    def status(self) -> Names:
        """(N,) names: how the position was found, or why there is none."""
        return self.positions.status

    @property
    def clearance(self) -> Floats:
        """(N, 2) mm: lower and upper bound of the distance from all faces; an infinite one is not proven."""
        return self.positions.clearance

    @property
    def pass_index(self) -> Integers:
        """(N,) from 0, as the footprint counts them."""
        return self.positions.pass_index

    @property
    def inserted(self) -> Flags:
        """(N,): not of the footprint, but put in between to prove a cut."""
        return self.positions.inserted

    @property
    def normals(self) -> Floats:
        """(N, 2, 3) unit, part frame: of the surface at the contacts, towards the tool; NaN: no contact."""
        return self.positions.normals

    @property
    def tilt_deg(self) -> Floats:
        """(N,) degrees: β of docs/glossary.md, the turn until the tool touches again."""
        return self.positions.tilt_deg

    @property
    def spin_deg(self) -> Floats:
        """(N,) degrees: α of docs/glossary.md, the turn before the tilt."""
        return self.positions.spin_deg

    @property
    def usable(self) -> Flags:
        """(N,): the path may go there."""
        return self.positions.usable

    @property
    def neighbours(self) -> Flags:
        """(N,): a cut should join the position and the one before it."""
        return self.positions.neighbours
