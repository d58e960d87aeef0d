"""The tool path: arrays, one row a move, mm."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ... import _core
from ..base import Flags, Floats, Integers, Names
from ..part import Frame


def path_in_part(path: ToolPath, frame: Frame) -> ToolPath:
    """From the set-up frame; tips in mm and axes, all else as it was."""
    return replace(path, tip=frame.to_part(path.tip), axis=frame.direction_to_part(path.axis))


@dataclass(frozen=True)
class ToolPath:
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


def from_core(found: _core.ToolPath) -> ToolPath:
    """The path as the core gives it, the kinds by their names."""
    return ToolPath(
        kind=np.array(_core.MOVE_KINDS)[found["kind"]],
        tip=found["tip"],
        axis=found["axis"],
        position=found["position"],
        pass_index=found["pass_index"],
        clearance=found["clearance"],
        blocked=found["blocked"],
        proven=found["proven"],
    )
