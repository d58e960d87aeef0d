"""Certificates of moves between two poses."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ... import _core
from ..base import Floats, Integers, Names, Stages
from ..job import Job, certified_depth_mm, control_deviation_deg, control_tip_deviation_mm
from ..part import Scene

STAGE = "motions"


class Certified(NamedTuple):
    """K moves."""

    lo: Floats  # (K,) mm: proven lower bound of the clearance
    hi: Floats  # (K,) mm: upper bound
    verdict: Names  # (K,) of _core.VERDICTS
    cells: Integers  # (K,) looked at


def certify(
    job: Job,
    scene: Scene,
    tip: Floats,
    axis: Floats,
    ends: Integers,
    depth_mm: Floats | float,
    stages: Stages,
) -> Certified:
    """Certificates of the moves that lead to the rows `ends` (K,) of tip, axis (N, 3) from the rows before them, which
    may cut in by depth_mm, one or (K,). A tip that is off its line takes as much off the clearance."""
    found = stages.run_native(
        STAGE,
        _core.certify_motions,
        scene.cells,
        scene.tool,
        tip[ends - 1],
        axis[ends - 1],
        tip[ends],
        axis[ends],
        tolerance_mm=certified_depth_mm(job, depth_mm),
        axis_deviation_deg=control_deviation_deg(job),
    )
    verdict = np.array(_core.VERDICTS)[found["verdict"]]
    return Certified(found["lo"] - control_tip_deviation_mm(job), found["hi"], verdict, found["cells"])
