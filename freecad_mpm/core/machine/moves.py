"""Moves of a machine, in machining order."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..base import Floats, InputError, Names

# What a move is for; all but rapids run at their feed.
MOVE_KINDS = ("rapid", "plunge", "cut", "retract", "link")


@dataclass(frozen=True)
class Moves:
    """M moves in machining order; move i ends in row i and starts in row i - 1. Set-up frame."""

    kind: Names  # (M,), of MOVE_KINDS
    tip: Floats  # (M, 3) mm
    axis: Floats  # (M, 3) unit, from the tip to the spindle
    rotary_deg: Floats  # (M, 2) readings of the machine's rotary axes, from the part to the tool, unwound
    feed_mm_per_min: Floats  # (M,) of the tip; rapids: not read

    def __post_init__(self) -> None:
        count = len(self.kind)
        for name, shape in (("tip", (count, 3)), ("axis", (count, 3)), ("rotary_deg", (count, 2))):
            check_array(name, getattr(self, name), shape)
        unknown = sorted(set(self.kind.tolist()) - set(MOVE_KINDS))
        if unknown:
            raise InputError(f"kind: must be of {', '.join(MOVE_KINDS)}, got {', '.join(unknown)}")
        check_array(
            "feed_mm_per_min", self.feed_mm_per_min[~self.is_rapid], (int(np.count_nonzero(~self.is_rapid)),)
        )
        slow = np.flatnonzero(~self.is_rapid & ~(self.feed_mm_per_min > 0))
        if len(slow):
            raise InputError(
                f"feed_mm_per_min[{slow[0]}]: must be positive, got {self.feed_mm_per_min[slow[0]]}"
            )

    def __len__(self) -> int:
        return len(self.kind)

    @property
    def is_rapid(self) -> NDArray[np.bool_]:
        """(M,): at the axes' own rates; every other kind runs at a feed."""
        return np.asarray(self.kind == "rapid")


def check_array(name: str, array: Floats, shape: tuple[int, ...]) -> None:
    """Raises InputError that names the array, and its first row that is not finite."""
    if array.shape != shape:
        raise InputError(f"{name}: must have shape {shape}, got {array.shape}")
    if not np.isfinite(array).all():
        row = np.flatnonzero(~np.isfinite(array.reshape(len(array), -1)).all(axis=1))[0]
        raise InputError(f"{name}[{row}]: must be finite")
