"""What the machine does: joints, finer blocks, rewinds, rapids proven as the joints run, times.

Native: `machine`. It never uses the kinematics of the checks (`control.kinematics`).
To add a machine: one file in resources/machines; `plan --proof` shows whether it is right."""

from __future__ import annotations

from .joints import JointPath, axes_of, feeds, joint_path, move_machine
from .machine import Machine, RotaryAxis, load, names
from .motion_time import SECONDS_PER_MINUTE, move_seconds, slowed_cuts
from .moves import MOVE_KINDS, Moves, check_array
from .rapids import with_rapids_proven
from .rewind import fit_to_machine, rewinds

__all__ = [
    "JointPath",
    "MOVE_KINDS",
    "Machine",
    "Moves",
    "RotaryAxis",
    "SECONDS_PER_MINUTE",
    "axes_of",
    "check_array",
    "feeds",
    "fit_to_machine",
    "joint_path",
    "load",
    "names",
    "move_machine",
    "move_seconds",
    "rewinds",
    "slowed_cuts",
    "with_rapids_proven",
]
