"""The figures of a report: what was counted and measured, each kind in a dataclass that JSON can hold."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..job import Tolerance
from ..path import ToolPath
from ..positioning import Positions
from .verdict import digging, gaps, gouging, undecided, unproven_links


@dataclass(frozen=True)
class PositionFigures:
    """How many positions, by status and by what is wrong with them."""

    count: int
    passes: int
    statuses: Mapping[str, int]
    with_first_contact: int
    with_second_contact: int
    gouging: int
    undecided: int
    left_out: int
    inserted: int
    guarantee: str

    @classmethod
    def of(cls, positions: Positions, tolerance: Tolerance, guarantee: str) -> PositionFigures:
        """Counts, with those of the positions that are too deep or undecided within the tolerance."""
        with_contact = np.isfinite(positions.contacts).all(axis=2)
        return cls(
            count=len(positions),
            passes=len(np.unique(positions.pass_index)),
            statuses=dict(Counter(positions.status.tolist()).most_common()),
            with_first_contact=int(np.count_nonzero(with_contact[:, 0])),
            with_second_contact=int(np.count_nonzero(with_contact[:, 1])),
            gouging=int(np.count_nonzero(gouging(positions, tolerance))),
            undecided=int(np.count_nonzero(undecided(positions, tolerance, guarantee))),
            left_out=int(np.count_nonzero(~positions.usable)),
            inserted=int(np.count_nonzero(positions.inserted)),
            guarantee=guarantee,
        )


@dataclass(frozen=True)
class WorstPosition:
    """The usable position with the least upper bound of its clearance; tip in the part's frame."""

    position: int
    pass_index: int
    tip_mm: list[float]
    axis: list[float]
    clearance_mm: float

    @classmethod
    def of(cls, positions: Positions) -> WorstPosition | None:
        """None when no position is usable."""
        if not positions.usable.any():
            return None
        worst = int(np.argmin(np.where(positions.usable, positions.clearance[:, 1], np.inf)))
        return cls(
            worst,
            int(positions.pass_index[worst]),
            positions.tip[worst].tolist(),
            positions.axis[worst].tolist(),
            float(positions.clearance[worst, 1]),
        )


@dataclass(frozen=True)
class PathFigures:
    """Moves by kind, and what is known of them."""

    moves: int
    kinds: Mapping[str, int]
    cut_length_mm: float
    worst_cut_clearance_mm: float | None
    cuts_too_deep: int
    cuts_guarantee: str
    moves_not_cut: int
    blocked_moves: int
    links_not_proven: list[int]

    @classmethod
    def of(cls, positions: Positions, path: ToolPath, tolerance: Tolerance, guarantee: str) -> PathFigures:
        """Lengths and clearances in mm; moves are counted from 0."""
        cuts = path.kind == "cut"
        lengths = np.linalg.norm(np.diff(path.tip, axis=0, prepend=path.tip[:1]), axis=1)
        return cls(
            moves=len(path),
            kinds=dict(Counter(path.kind.tolist()).most_common()),
            cut_length_mm=float(lengths[cuts].sum()),
            worst_cut_clearance_mm=float(path.clearance[cuts].min()) if cuts.any() else None,
            cuts_too_deep=int(np.count_nonzero(digging(path, tolerance, guarantee))),
            cuts_guarantee=guarantee,
            moves_not_cut=len(gaps(positions, path)),
            blocked_moves=int(np.count_nonzero(path.blocked)),
            links_not_proven=np.flatnonzero(unproven_links(path)).tolist(),
        )


@dataclass(frozen=True)
class TimeFigures:
    """Wall time of the stages, s."""

    stages_s: Mapping[str, float]
    total_s: float
    positions_per_second: float

    @classmethod
    def of(cls, seconds: Mapping[str, float], positions: Positions) -> TimeFigures:
        """seconds: wall time by stage. Inserted positions do not count for the rate."""
        of_footprint = int(np.count_nonzero(~positions.inserted))
        return cls(dict(seconds), sum(seconds.values()), of_footprint / seconds["positions"])
