"""What a plan holds: arrays, one row a position or move, all in the part's frame and mm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .job import Job
from .machine_path import MachinePath
from .model import Scene

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]
Names = NDArray[np.str_]

# Statuses of positions that no path may use: there is no pose, or nobody knows whether it is good.
UNUSABLE = ("not_computed", "off_part", "undecided")


@dataclass(frozen=True)
class Positions:
    """N positions in the footprint's order."""

    tip: Floats  # (N, 3), on the axis: torus centre - Ri * axis; NaN: none
    axis: Floats  # (N, 3), unit, from the tip to the spindle
    contacts: Floats  # (N, 2, 3), P and Q; NaN: none
    normals: Floats  # (N, 2, 3), of the surface there, towards the tool
    status: Names  # (N,)
    clearance: Floats  # (N, 2), bounds of the tool's least distance from all faces; a bound nobody proved is infinite
    tilt_deg: Floats  # (N,)
    spin_deg: Floats  # (N,)
    pass_index: Integers  # (N,), from 0
    inserted: Flags  # (N,): not of the footprint, but put between two of its positions to prove the cut

    def __len__(self) -> int:
        return len(self.status)

    @property
    def usable(self) -> Flags:
        """(N,): the path may go there."""
        return np.isfinite(self.tip).all(axis=1) & ~np.isin(self.status, UNUSABLE)

    @property
    def neighbours(self) -> Flags:
        """(N,): the position and the one before it are usable and of one pass, so that a cut should join them."""
        result = np.zeros(len(self), dtype=bool)
        usable, passes = self.usable, self.pass_index
        result[1:] = usable[1:] & usable[:-1] & (passes[1:] == passes[:-1])
        return result


@dataclass(frozen=True)
class Path:
    """M moves in machining order; move i ends in row i and starts in row i - 1."""

    kind: Names  # (M,): cut, link, rapid, plunge, retract
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3)
    position: Integers  # (M,), index of the position the move ends in, -1: none
    pass_index: Integers  # (M,)
    clearance: Floats  # (M,), mm, least clearance along the move: proven, or of rapids and the others sampled
    blocked: Flags  # (M,): no free way was found
    proven: Flags  # (M,): cuts in no deeper than it may, with all that the control may be off

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True)
class ProgramFile:
    """The post's text and the file name it belongs under."""

    file_name: str
    text: str


@dataclass(frozen=True)
class Plan(Positions):
    """A computed job: its positions, the path over them, and what was made of it."""

    job: Job
    scene: Scene
    path: Path
    joints: MachinePath  # set-up frame, with the moves the machine needs in between
    program: ProgramFile
    report: dict[str, Any]
