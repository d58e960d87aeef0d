"""A second opinion on a CL file, ours or not: every pose and every move against all faces of the job."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ... import _core
from ..base import Flags, Floats, Names, Stages
from ..job import PROVEN, Job, cut_depth_mm
from ..part import prepare
from .certify import certify
from .cl_file import ClMoves


@dataclass(frozen=True)
class Verification:
    """`clearance` (M,): least sampled distance of the tool from all faces at each pose, mm, negative when it cuts in.

    `verdict` (M - 1,) of the moves that lead to all rows but the first: free, gouge or undecided; within the chord
    tolerance, of a rapid within nothing."""

    job: Job
    moves: ClMoves
    clearance: Floats
    verdict: Names

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
        """No pose cuts in too deep, and every move is proven free: "undecided" is not good."""
        return not self.too_deep.any() and bool((self.verdict == "free").all())

    @property
    def lines(self) -> list[str]:
        """What was found, for people."""
        tolerance = self.job.tolerance.gouge_mm
        gouging = int(np.count_nonzero(self.too_deep))
        worst = int(np.argmin(self.clearance))
        verdict = "good" if self.good else "NOT GOOD"
        return [
            f"Verdict: {verdict} (moves proven, poses sampled)",
            f"{len(self.moves)} poses, {gouging} cut in deeper than {tolerance:g} mm",
            f"Worst clearance: {self.clearance[worst]:.6f} mm {self._where(worst)}",
            *self._move_lines("cuts", self.moves.kind == "cut"),
            *self._move_lines("links", self.moves.kind != "cut"),
        ]

    def _move_lines(self, name: str, which: Flags) -> list[str]:
        """Of the moves to these rows."""
        free, gouge = self.verdict == "free", self.verdict == "gouge"
        counts = [int(np.count_nonzero(of & which[1:])) for of in (free | ~free, free, gouge, ~free & ~gouge)]
        depth = cut_depth_mm(self.job.tolerance, PROVEN)
        lines = [
            f"{counts[0]} {name}, {counts[1]} proven free within {depth:g} mm (rapids: clear), "
            f"{counts[2]} cut in deeper, {counts[3]} undecided"
        ]
        bad = np.flatnonzero(~free & which[1:]) + 1
        lines += [f"First bad one: {self._where(int(row))}" for row in bad[:1]]
        return lines

    def _where(self, row: int) -> str:
        x, y, z = self.moves.tip[row]
        return (
            f"on line {self.moves.line[row]} ({self.moves.kind[row]}, pass {self.moves.pass_index[row]}), "
            f"tip {x:.3f} {y:.3f} {z:.3f}"
        )


def verify(job: Job, moves: ClMoves, stages: Stages) -> Verification:
    """Sample the clearance of every pose and certify every move: within the chord tolerance, rapids to be clear.
    Method, footprint and machine of the job are not used: a rapid turns on the great circle here."""
    scene = prepare(job, None, stages)
    tip, axis = scene.frame.to_setup(moves.tip), scene.frame.direction_to_setup(moves.axis)
    clearance = stages.run_native("judge", _core.sampled_clearance, scene.model, scene.tool, tip, axis)
    depth_mm = np.where(moves.kind == "rapid", 0.0, cut_depth_mm(job.tolerance, PROVEN))
    found = certify(job, scene, tip, axis, np.arange(1, len(moves)), depth_mm[1:], stages)
    return Verification(job, moves, clearance, found.verdict)
