"""A second opinion on a CL file, ours or not: every pose against all faces of the job."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .cl_file import Moves
from .job import Job
from .plan import Floats
from .planning import prepare
from .stages import Stages


@dataclass(frozen=True)
class Verification:
    """`clearance` (M,): least sampled distance of the tool from all faces at each pose, mm, negative when it cuts in."""

    job: Job
    moves: Moves
    clearance: Floats

    @property
    def good(self) -> bool:
        return bool((self.clearance >= -self.job.tolerance.gouge_mm).all())

    @property
    def lines(self) -> list[str]:
        """What was found, for people."""
        tolerance = self.job.tolerance.gouge_mm
        gouging = int(np.count_nonzero(self.clearance < -tolerance))
        worst = int(np.argmin(self.clearance))
        x, y, z = self.moves.tip[worst]
        return [
            f"Verdict: {'good' if self.good else 'NOT GOOD'} (sampled: no proof; poses only, not the moves between)",
            f"{len(self.moves)} poses, {gouging} cut in deeper than {tolerance:g} mm",
            f"Worst clearance: {self.clearance[worst]:.6f} mm on line {self.moves.line[worst]} "
            f"({self.moves.kind[worst]}, pass {self.moves.pass_index[worst]}), tip {x:.3f} {y:.3f} {z:.3f}",
        ]


def verify(job: Job, moves: Moves, stages: Stages) -> Verification:
    """Sample the clearance of every pose; method, footprint, machine and post of the job are not used."""
    scene = prepare(job, None, stages)
    tip, axis = scene.frame.to_setup(moves.tip), scene.frame.direction_to_setup(moves.axis)
    clearance = stages.run_native("judge", _core.sampled_clearance, scene.model, scene.tool, tip, axis)
    return Verification(job, moves, clearance)
