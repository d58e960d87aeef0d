"""The neutral description of a program that every post writes from."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..base import Floats, InputError
from ..machine import Machine, Moves, check_array
from .options import PostOptions

# Letters of a program's name, and how many the controls in the field take.
PROGRAM_NAME = re.compile(r"[A-Z0-9_]{1,16}")
MAX_NAME_LENGTH = 16


@dataclass(frozen=True)
class ProgramTool:
    """The cutter as a control's tool table has it: corner radius 0 is an end mill, equal to the radius a ball."""

    number: int
    radius_mm: float  # over all: Ro + Ri
    corner_radius_mm: float  # Ri


@dataclass(frozen=True)
class Program:
    """One tool, one set-up. `blank` is (low corner, high corner) in mm, set-up frame; only for the control's picture."""

    name: str
    machine: Machine
    tool: ProgramTool
    spindle_rpm: float
    moves: Moves
    blank: tuple[Floats, Floats] | None = None
    # (M, 3) X, Y and Z of each move for a control that moves the joints and knows nothing of the tip: the linear axes'
    # readings less datum and tool length, so that with all rotary axes at zero they are the tip. None: the control holds
    # the tip, and X, Y and Z are its coordinates.
    axes_mm: Floats | None = None
    options: PostOptions = PostOptions()
    spindle_on: bool = True
    stops: Mapping[int, str] = field(
        default_factory=dict
    )  # move after which the machine waits, and a comment

    @property
    def spindle_word(self) -> str:
        """M3, or M5 for a program that only shows the way."""
        return "M3" if self.spindle_on else "M5"

    @property
    def tcp(self) -> bool:
        """Whether the control holds the tip (tool-centre-point control)."""
        return self.axes_mm is None

    @property
    def xyz_mm(self) -> Floats:
        """(M, 3) what the words X, Y and Z of each move say."""
        return self.moves.tip if self.axes_mm is None else self.axes_mm

    def __post_init__(self) -> None:
        if not PROGRAM_NAME.fullmatch(self.name):
            raise InputError(
                f"program name '{self.name}': must be 1 to {MAX_NAME_LENGTH} capital letters, digits and _;"
                f" {program_name(self.name)} would be right"
            )
        if not (np.isfinite(self.spindle_rpm) and self.spindle_rpm > 0):
            raise InputError(f"spindle_rpm: must be positive, got {self.spindle_rpm}")
        if self.tool.number < 1:
            raise InputError(f"tool number: must be 1 or more, got {self.tool.number}")
        if len(self.moves) == 0 or self.moves.kind[0] != "rapid":
            raise InputError("moves: the first must be a rapid to a place clear of the part")
        if self.axes_mm is not None:
            check_array("axes_mm", self.axes_mm, (len(self.moves), 3))


def program_name(title: str) -> str:
    """A name that every control takes, made from any text."""
    name = re.sub(r"[^A-Z0-9_]+", "_", title.upper()).strip("_")[:MAX_NAME_LENGTH]
    return name or "MPM"
