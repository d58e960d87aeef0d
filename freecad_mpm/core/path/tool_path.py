"""The tool path: arrays, one row a move, mm."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..base import Flags, Floats, Integers, Names
from ..part import Frame


def path_in_part(path: ToolPath, frame: Frame) -> ToolPath:
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
