"""Where a program's text takes the tool: by tip coordinates, or by joints and forward kinematics."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..base import Floats
from ..machine import Machine
from . import kinematics
from .control import Control
from .reader import Motion


@dataclass(frozen=True)
class Poses:
    """Where the tool is at the end of those moves of which that is known."""

    row: NDArray[np.int64]  # (P,) of the motion
    tip: Floats  # (P, 3); NaN: not known
    axis: Floats  # (P, 3)
    angles: Floats  # (P, 2)
    linear: Floats  # (P, 3) readings; NaN: not known


def poses_of(motion: Motion, machine: Machine, control: Control) -> Poses:
    """By the angles or the direction that the text gives, and the tip or the joints."""
    angles = angles_of(motion, machine)
    row = np.flatnonzero(posed(motion, machine, control))
    by_angles = kinematics.tool_axes(machine, angles[row])
    axis = np.where(np.isnan(motion.axis[row]), by_angles, motion.axis[row])
    origin, length = control.setup_of(machine)
    linear = motion.linear[row] + kinematics.datum_mm(machine, origin, length)
    tip = motion.tip[row] if control.tcp else kinematics.tips(machine, linear, angles[row], origin, length)
    return Poses(row, tip, axis, angles[row], linear)


def posed(motion: Motion, machine: Machine, control: Control) -> NDArray[np.bool_]:
    """(K,): the move ends in a pose of the tool that the text tells."""
    if control.tcp:
        return motion.tcp
    known = np.isfinite(motion.linear).all(axis=1) & np.isfinite(angles_of(motion, machine)).all(axis=1)
    return np.asarray(known)


def angles_of(motion: Motion, machine: Machine) -> Floats:
    """(K, 2) in the machine's order, from the part to the tool."""
    return np.column_stack([motion.angles[letter] for letter in machine.rotary_letters])
