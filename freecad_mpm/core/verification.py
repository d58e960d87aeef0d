"""A second opinion on a CL file, ours or not: every pose and every cut against all faces of the job."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import _core
from .cl_file import Moves
from .job import Job
from .motions import certify
from .plan import Flags, Floats, Integers, Names
from .planning import prepare
from .stages import Stages
from .verdict import PROVEN, cut_depth_mm


@dataclass(frozen=True)
class Verification:
    """`clearance` (M,): least sampled distance of the tool from all faces at each pose, mm, negative when it cuts in.

    `cuts` (K,): rows that a cut leads to from the row before; `cut_verdict` (K,): free, gouge or undecided within the
    chord tolerance."""

    job: Job
    moves: Moves
    clearance: Floats
    cuts: Integers
    cut_verdict: Names

    @property
    def too_deep(self) -> Flags:
        """(M,): poses that cut in deeper than they may: positions by the gouge tolerance, and places between two
        positions, where a cut is interrupted, as deep as the cut itself."""
        moves, tolerance = self.moves, self.job.tolerance
        poses = list(map(tuple, np.hstack((moves.tip, moves.axis)).tolist()))
        between = {poses[row] for row in np.flatnonzero(moves.between).tolist()}
        inside = np.array([pose in between for pose in poses])
        return self.clearance < -np.where(inside, cut_depth_mm(tolerance, PROVEN), tolerance.gouge_mm)

    @property
    def good(self) -> bool:
        return not self.too_deep.any() and bool((self.cut_verdict == "free").all())

    @property
    def lines(self) -> list[str]:
        """What was found, for people."""
        tolerance = self.job.tolerance.gouge_mm
        gouging = int(np.count_nonzero(self.too_deep))
        worst = int(np.argmin(self.clearance))
        verdict = "good" if self.good else "NOT GOOD"
        return [
            f"Verdict: {verdict} (cuts proven, poses sampled; links are judged at their poses only)",
            f"{len(self.moves)} poses, {gouging} cut in deeper than {tolerance:g} mm",
            f"Worst clearance: {self.clearance[worst]:.6f} mm {self._where(worst)}",
            *self._cut_lines(),
        ]

    def _cut_lines(self) -> list[str]:
        depth = cut_depth_mm(self.job.tolerance, PROVEN)
        free, gouge = self.cut_verdict == "free", self.cut_verdict == "gouge"
        open_ones = int(np.count_nonzero(~free & ~gouge))
        lines = [
            f"{len(self.cuts)} cuts, {np.count_nonzero(free)} proven free within {depth:g} mm, "
            f"{np.count_nonzero(gouge)} cut in deeper, {open_ones} undecided"
        ]
        lines += [f"First bad cut: {self._where(int(row))}" for row in self.cuts[~free][:1]]
        return lines

    def _where(self, row: int) -> str:
        x, y, z = self.moves.tip[row]
        return (
            f"on line {self.moves.line[row]} ({self.moves.kind[row]}, pass {self.moves.pass_index[row]}), "
            f"tip {x:.3f} {y:.3f} {z:.3f}"
        )


def verify(job: Job, moves: Moves, stages: Stages) -> Verification:
    """Sample the clearance of every pose and certify every cut within the chord tolerance; method, footprint, machine
    and post of the job are not used."""
    scene = prepare(job, None, stages)
    tip, axis = scene.frame.to_setup(moves.tip), scene.frame.direction_to_setup(moves.axis)
    clearance = stages.run_native("judge", _core.sampled_clearance, scene.model, scene.tool, tip, axis)
    cuts = np.flatnonzero(cutting(moves))
    found = certify(job, scene, tip, axis, cuts, stages)
    return Verification(job, moves, clearance, cuts, found["verdict"])


def cutting(moves: Moves) -> Flags:
    """(M,): a cut leads to the row from the one before."""
    result = moves.kind == "cut"
    result[:1] = False
    return np.asarray(result)
