"""What a program's tool does between the ends of its blocks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..base import Floats
from ..machine import Machine
from . import kinematics
from .control import Control
from .finding import Finding, finding_at
from .poses import Poses, poses_of
from .reader import ParsedProgram

# Fractions of a feed move at which the tool is compared with the way it was meant to take.
BETWEEN = (0.25, 0.5, 0.75)


@dataclass(frozen=True)
class Straightness:
    """How far the tool leaves the way between the ends of the feed moves while the rotary axes run evenly."""

    findings: list[Finding]
    tip_mm: float
    axis_deg: float


def check_straightness(
    program: ParsedProgram, machine: Machine, control: Control = Control()
) -> Straightness:
    """Between the ends of a feed move the tip keeps its line and the axis its great circle within the control's
    allowances, looked at at three places; a control that holds the tip is taken at its word. Directions that the text
    gives as vectors are turned by the control on the great circle."""
    motion = program.motion()
    poses = poses_of(motion, machine, control)
    end = 1 + np.flatnonzero((np.diff(poses.row) == 1) & ~motion.rapid[poses.row[1:]])
    end = end[np.isnan(motion.axis[poses.row[end]]).all(axis=1)]
    tip_off, axis_off = np.zeros(len(end)), np.zeros(len(end))
    for s in BETWEEN:
        tip, axis = _between(poses, machine, control, end, s)
        meant = poses.tip[end - 1] + s * (poses.tip[end] - poses.tip[end - 1])
        if not control.tcp:
            tip_off = np.maximum(tip_off, np.linalg.norm(tip - meant, axis=1))
        circle = kinematics.great_circle(poses.axis[end - 1], poses.axis[end], s)
        axis_off = np.maximum(axis_off, kinematics.angles_between_deg(axis, circle))
    findings = []
    for k in np.flatnonzero((tip_off > control.between_mm) | (axis_off > control.between_deg)).tolist():
        message = f"leaves its way: the tip by {tip_off[k]:.4f} mm, the axis by {axis_off[k]:.4f} degrees"
        findings.append(finding_at("straightness", program, motion, int(poses.row[end[k]]), message))
    return Straightness(findings, float(tip_off.max(initial=0.0)), float(axis_off.max(initial=0.0)))


def _between(
    poses: Poses, machine: Machine, control: Control, end: NDArray[np.int64], s: float
) -> tuple[Floats, Floats]:
    """Tip and axis a fraction s of the way in the moves that end there, all five axes running evenly."""
    origin, length = control.setup_of(machine)
    angles = poses.angles[end - 1] + s * (poses.angles[end] - poses.angles[end - 1])
    linear = poses.linear[end - 1] + s * (poses.linear[end] - poses.linear[end - 1])
    return kinematics.tips(machine, linear, angles, origin, length), kinematics.tool_axes(machine, angles)
