"""Positions: arrays, one row a position, mm."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..base import Flags, Floats, Integers, Names
from ..part import Frame


def positions_in_part(positions: Positions, frame: Frame) -> Positions:
    """From the set-up frame; tips and contacts in mm, axes and normals, all else as it was."""
    return replace(
        positions,
        tip=frame.to_part(positions.tip),
        axis=frame.direction_to_part(positions.axis),
        contacts=frame.to_part(positions.contacts),
        normals=frame.direction_to_part(positions.normals),
    )


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
