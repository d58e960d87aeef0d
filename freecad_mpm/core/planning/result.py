"""What a plan holds: arrays, one row a position or move, all in the part's frame and mm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..job import Job
from ..machine import JointPath
from ..part import Scene
from ..path import ToolPath
from ..positioning import Positions
from ..program import ProgramFile


@dataclass(frozen=True)
class Plan(Positions):
    """A computed job: its positions, the path over them, and what was made of it."""

    job: Job
    scene: Scene
    path: ToolPath
    joints: JointPath  # set-up frame, with the moves the machine needs in between
    program: ProgramFile
    report: dict[str, Any]
