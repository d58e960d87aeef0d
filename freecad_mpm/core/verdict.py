"""Whether a plan is good: what the exit status and the report's first line say."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .job import Tolerance
from .plan import Flags, Path, Positions

PROVEN = "proven"


@dataclass(frozen=True)
class Verdict:
    """`troubles`: one line each, none when the plan is good; `guarantee`: sampled or proven."""

    guarantee: str
    troubles: tuple[str, ...]

    @property
    def good(self) -> bool:
        return not self.troubles

    @property
    def line(self) -> str:
        basis = (
            "positions proven, moves between them sampled"
            if self.guarantee == PROVEN
            else "sampled: no proof"
        )
        return f"{'good' if self.good else 'NOT GOOD: ' + '; '.join(self.troubles)} ({basis})"


def gouging(positions: Positions, tolerance: Tolerance) -> Flags:
    """(N,): positions that certainly cut in deeper than the tolerance."""
    return positions.usable & (positions.clearance[:, 1] < -tolerance.gouge_mm)


def undecided(positions: Positions, tolerance: Tolerance, guarantee: str) -> Flags:
    """(N,): positions of which the method does not say whether they are free; a sampled method never proves it."""
    open_proof = (
        positions.usable & (positions.clearance[:, 0] < -tolerance.gouge_mm) & ~gouging(positions, tolerance)
    )
    return (positions.status == "undecided") | (open_proof if guarantee == PROVEN else False)


def digging(path: Path, tolerance: Tolerance) -> Flags:
    """(M,): cuts that go deeper between their positions than gouge and chord tolerance together allow."""
    return (path.kind == "cut") & (path.clearance < -(tolerance.gouge_mm + tolerance.chord_mm))


def judge(
    positions: Positions, path: Path, machine_troubles: Sequence[str], tolerance: Tolerance, guarantee: str
) -> Verdict:
    """machine_troubles: one line for each kind of thing that the machine cannot do."""
    depth = tolerance.gouge_mm + tolerance.chord_mm
    counts = {
        f"positions cut in deeper than {tolerance.gouge_mm:g} mm": gouging(positions, tolerance),
        "positions are undecided": undecided(positions, tolerance, guarantee),
        f"cuts go deeper than {depth:g} mm between positions": digging(path, tolerance),
        "moves run into the part": path.blocked,
    }
    found = [f"{np.count_nonzero(which)} {what}" for what, which in counts.items() if which.any()]
    return Verdict(guarantee, (*found, *machine_troubles))
