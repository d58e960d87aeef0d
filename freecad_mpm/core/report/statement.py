"""The one sentence that a report ends with: what is known of the tool all along the path, and what is not."""

from __future__ import annotations

import numpy as np

from ..job import PROVEN, Tolerance, cut_depth_mm
from ..path import ToolPath
from ..positioning import Positions
from .verdict import digging, gaps, gouging, undecided, unproven_links

MICROMETRES = 1000.0  # in a millimetre


def statement(positions: Positions, path: ToolPath, tolerance: Tolerance, guarantee: str) -> str:
    """Says "proven" only of what was."""
    usable = int(np.count_nonzero(positions.usable))
    bad = gouging(positions, tolerance) | undecided(positions, tolerance, guarantee)
    good = usable - int(np.count_nonzero(bad & positions.usable))
    left_out = len(positions) - usable
    cuts = int(np.count_nonzero(path.kind == "cut"))
    good_cuts = cuts - int(np.count_nonzero(digging(path, tolerance, guarantee)))
    sentence = (
        f"free to {_micrometres(tolerance.gouge_mm)} at {_of(good, usable, 'positions')}, "
        f"within {_micrometres(cut_depth_mm(tolerance, guarantee))} on {_of(good_cuts, cuts, 'cuts')} between them, "
        f"{'' if guarantee == PROVEN else 'sampled: no proof; '}{_links(path, cut_depth_mm(tolerance, guarantee))}"
    )
    not_cut = len(gaps(positions, path))
    return (
        sentence
        + (f"; {not_cut} moves between neighbours are not cut" if not_cut else "")
        + (f"; {left_out} positions are left out" if left_out else "")
    )


def _links(path: ToolPath, depth_mm: float) -> str:
    """What is proven of the moves that do not cut, for every method."""
    rapid, bad = path.kind == "rapid", unproven_links(path)
    rapid[:1] = False  # where the path begins, nothing leads there
    slow = (path.kind != "rapid") & (path.kind != "cut")
    counts = [(int(np.count_nonzero(which & ~bad)), int(np.count_nonzero(which))) for which in (slow, rapid)]
    return (
        f"within {_micrometres(depth_mm)} on {_of(*counts[0], 'plunges and retracts')}, "
        f"clear on {_of(*counts[1], 'rapids')}, proven"
    )


def _of(good: int, count: int, what: str) -> str:
    return f"all {count} {what}" if good == count else f"{good} of {count} {what}"


def _micrometres(length_mm: float) -> str:
    return f"{length_mm * MICROMETRES:g} µm"
