"""What the reader must know although it does not make a plan bad."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ..base import Integers
from ..job import PROVEN, Job
from ..machine import JointPath, Machine, rewinds, slowed_cuts
from ..path import ToolPath
from ..positioning import Positions
from .verdict import gaps, unproven_links

# So many positions are named in a warning.
LISTED_POSITIONS = 10


def warnings(job: Job, machine: Machine, positions: Positions, path: ToolPath, guarantee: str) -> list[str]:
    """What the reader must know although it does not make the plan bad."""
    found = []
    if guarantee != PROVEN:
        found.append("positions and cuts are sampled: no proof that nothing between the samples is cut")
    if not job.tool.shank and not job.tool.holder:
        found.append("the tool has no shank and no holder: only the flutes are kept clear of the part")
    if machine.unconfirmed:
        found.append(
            f"machine {machine.name} is unconfirmed: compare its file with the machine before cutting"
        )
    left_out = Counter(positions.status[~positions.usable].tolist())
    if left_out:
        found.append(f"{left_out.total()} positions ({', '.join(left_out)}) are left out of the path")
    turned = rewinds(path)
    if len(turned):
        places = _listed(turned)
        found.append(
            f"{len(turned)} cuts are interrupted for a rotary axis to rewind on the safe plane, "
            f"before positions {places}"
        )
    missing = gaps(positions, path)
    if len(missing):
        found.append(
            f"{len(missing)} moves between neighbours of a pass are not cut: the tool retracts before positions "
            f"{_listed(missing)}"
        )
    return found


def unproven(path: ToolPath) -> list[str]:
    """The links that nobody could prove, with what is known of their clearance."""
    links = np.flatnonzero(unproven_links(path)).tolist()
    if not links:
        return []
    named = [
        f"{path.kind[move]} {_place(path, move)} (least clearance sampled {path.clearance[move]:.4f} mm)"
        for move in links[:LISTED_POSITIONS]
    ]
    more = ", …" if len(links) > LISTED_POSITIONS else ""
    return [f"{len(links)} links are not proven free: {', '.join(named)}{more}"]


def _place(path: ToolPath, move: int) -> str:
    """Words for the position that a link leaves or makes for; the pass where there is none."""
    named = path.position >= 0
    if path.kind[move] == "retract":
        before = np.flatnonzero(named[:move])
        return f"from position {path.position[before[-1]]}" if len(before) else "at the start"
    after = np.flatnonzero(named[move:])
    return f"to position {path.position[move + after[0]]}" if len(after) else "at the end"


def slowed(machine: Machine, path: ToolPath, joints: JointPath) -> list[str]:
    """Cuts in which the rotary axes cannot follow the feed."""
    moves = np.unique(joints.move[slowed_cuts(machine, joints)])
    places = path.position[moves][path.position[moves] >= 0]
    if not len(places):
        return []
    return [
        f"the rotary axes slow {len(places)} cuts down to less than half their feed, to positions {_listed(places)}"
    ]


def _listed(positions: Integers) -> str:
    more = ", …" if len(positions) > LISTED_POSITIONS else ""
    return ", ".join(map(str, positions[:LISTED_POSITIONS])) + more
