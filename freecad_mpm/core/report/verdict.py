"""Whether a plan is good: what the exit status and the report's first line say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..base import Flags, Integers
from ..job import PROVEN, Tolerance, cut_depth_mm
from ..path import ToolPath
from ..positioning import Positions


@dataclass(frozen=True)
class Verdict:
    """`troubles`: one line each, none when the plan is good; `guarantee`: sampled or proven."""

    guarantee: str
    troubles: tuple[str, ...]

    @property
    def good(self) -> bool:
        """Nothing speaks against the plan; what "good" rests on is the guarantee."""
        return not self.troubles

    def with_trouble(self, trouble: str) -> Verdict:
        """With one more; this one stays as it is."""
        return Verdict(self.guarantee, (*self.troubles, trouble))

    @property
    def facts(self) -> dict[str, Any]:
        """For report.json."""
        return {"good": self.good, "line": self.line, "troubles": list(self.troubles)}

    @property
    def line(self) -> str:
        """For people: whether it is good, why not, and what that rests on."""
        basis = (
            "positions, cuts and links proven"
            if self.guarantee == PROVEN
            else "positions and cuts sampled: no proof; links proven"
        )
        return f"good ({basis})" if self.good else f"NOT GOOD: {'; '.join(self.troubles)} (else {basis})"


def gouging(positions: Positions, tolerance: Tolerance) -> Flags:
    """(N,): positions that certainly cut in deeper than the tolerance."""
    return positions.usable & (positions.clearance[:, 1] < -tolerance.gouge_mm)


def undecided(positions: Positions, tolerance: Tolerance, guarantee: str) -> Flags:
    """(N,): positions of which the method does not say whether they are free; a sampled method never proves it."""
    open_proof = (
        positions.usable & (positions.clearance[:, 0] < -tolerance.gouge_mm) & ~gouging(positions, tolerance)
    )
    return (positions.status == "undecided") | (open_proof if guarantee == PROVEN else False)


def digging(path: ToolPath, tolerance: Tolerance, guarantee: str) -> Flags:
    """(M,): cuts that go deeper than cut_depth_mm between their positions, or of which that is not known."""
    return (path.kind == "cut") & ~(path.clearance >= -cut_depth_mm(tolerance, guarantee))


def unproven_links(path: ToolPath) -> Flags:
    """(M,): plunges, retracts and rapids of which nobody knows that they cut in no deeper than they may."""
    return (path.kind != "cut") & ~path.proven


def gaps(positions: Positions, path: ToolPath) -> Integers:
    """The positions that a cut from their neighbour in the pass should lead to and none does: the tool retracts and
    plunges instead."""
    missing = positions.neighbours
    missing[path.position[(path.kind == "cut") & (path.position >= 0)]] = False
    return np.flatnonzero(missing)


def judge(
    positions: Positions,
    path: ToolPath,
    machine_troubles: Sequence[str],
    tolerance: Tolerance,
    guarantee: str,
    allow_gaps: bool,
) -> Verdict:
    """machine_troubles: one line for each kind of thing that the machine cannot do. allow_gaps: what is asked for and
    not cut is no trouble."""
    depth = cut_depth_mm(tolerance, guarantee)
    counts = {
        f"positions cut in deeper than {tolerance.gouge_mm:g} mm": gouging(positions, tolerance),
        "positions are undecided": undecided(positions, tolerance, guarantee),
        f"cuts go deeper than {depth:g} mm between positions": digging(path, tolerance, guarantee),
        "moves run into the part": path.blocked,
        "links are not proven free": unproven_links(path) & ~path.blocked,
    }
    found = [f"{np.count_nonzero(which)} {what}" for what, which in counts.items() if which.any()]
    not_cut = len(gaps(positions, path))
    if not_cut and not allow_gaps:
        found.append(f"{not_cut} moves between neighbours of a pass are not cut")
    return Verdict(guarantee, (*found, *machine_troubles))
