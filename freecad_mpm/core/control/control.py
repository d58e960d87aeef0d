"""What the checks of a program take for granted of the control, the set-up, and how far blocks may miss."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base import Floats
from ..machine import Machine


@dataclass(frozen=True)
class Control:
    """tcp: the control holds the tip; else the program moves the joints.

    part_origin_mm (of the set-up in the machine frame) and tool_length_mm: None takes the machine file's."""

    tcp: bool = True
    part_origin_mm: tuple[float, ...] | None = None
    tool_length_mm: float | None = None
    # Between the ends of a feed move: of the tip off its line where nothing holds it, of the axis off its great circle.
    between_mm: float = 0.01
    between_deg: float = float("inf")
    spindle: bool = True  # feed moves cut: the spindle must be on

    def setup_of(self, machine: Machine) -> tuple[Floats, float]:
        """Origin of the set-up in the machine frame, and tool length."""
        setup = machine.setup
        origin = setup.part_origin_mm if self.part_origin_mm is None else self.part_origin_mm
        return np.array(origin), setup.tool_length_mm if self.tool_length_mm is None else self.tool_length_mm
