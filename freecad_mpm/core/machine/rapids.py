"""Proving the rapids, which no cut's deviation bounds: piece by piece as the machine's joints run between two blocks.

A rapid may turn a rotary axis by any angle, far off the great circle. Its pieces are short enough to be near theirs,
and each is certified with the bound of what it is off by."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ... import _core
from ..base import Floats, Integers, Stages
from ..job import Job
from ..part import Scene
from ..path import ToolPath
from .joints import JointPath
from .machine import Machine

# A rotary axis turns so far in one piece at most. The axis is then off its great circle by less than a thousandth of a
# radian: 0.1 mm at the top of a tool of 100 mm.
PIECE_DEG = 5.0


def with_rapids_proven(
    job: Job, machine: Machine, scene: Scene, path: ToolPath, joints: JointPath, stages: Stages
) -> ToolPath:
    """The path, all in the set-up frame, with its rapids `proven` where every piece of what the machine makes of them is
    clear of all faces. The first move has no start and counts as proven."""
    pieces = _pieces(machine, joints, hold_tip=job.post.tcp)
    found = stages.run_native(
        "path",
        _core.certify_motions,
        scene.cells,
        scene.tool,
        pieces.tip,
        pieces.axis,
        pieces.tip_to,
        pieces.axis_to,
        tolerance_mm=-pieces.tip_off_mm,
        axis_deviation_deg=pieces.axis_off_deg,
    )
    rapid = path.kind == "rapid"
    free = found["verdict"] == _core.VERDICTS.index("free")
    proven = np.where(rapid, True, path.proven)
    proven[joints.move[pieces.row[~free]]] = False
    return replace(path, proven=proven)


@dataclass(frozen=True)
class _Pieces:
    """K moves with the tip on a line and the axis on a great circle, and what the real ones are off by."""

    row: Integers  # (K,) of the machine's moves
    tip: Floats  # (K, 3)
    axis: Floats  # (K, 3)
    tip_to: Floats  # (K, 3)
    axis_to: Floats  # (K, 3)
    tip_off_mm: Floats  # (K,)
    axis_off_deg: Floats  # (K,)


def _pieces(machine: Machine, joints: JointPath, hold_tip: bool) -> _Pieces:
    """Of the rapids. hold_tip: the control keeps the tip on its line, else all five axes run evenly."""
    rapids = np.flatnonzero(joints.kind[1:] == "rapid") + 1
    turn = np.abs(joints.rotary_deg[rapids] - joints.rotary_deg[rapids - 1]).max(axis=1)
    counts = np.maximum(np.ceil(turn / PIECE_DEG), 1).astype(np.int64)
    row = np.repeat(rapids, counts)
    number = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    start, end = number / np.repeat(counts, counts), (number + 1) / np.repeat(counts, counts)

    def at(column: Floats, fraction: Floats) -> Floats:
        part = fraction[:, None]
        return np.asarray((1 - part) * column[row - 1] + part * column[row])

    chain, setup = machine.chain(), machine.setup.native()
    readings = [at(column, when) for when in (start, end) for column in (joints.linear_mm, joints.rotary_deg)]
    tip, axis = chain.forward(*readings[:2], setup=setup)
    tip_to, axis_to = chain.forward(*readings[2:], setup=setup)
    tip_off_mm, axis_off_deg = chain.deviation_bound(*readings, setup=setup)
    if hold_tip:
        tip, tip_to, tip_off_mm = at(joints.tip, start), at(joints.tip, end), np.zeros(len(row))
    return _Pieces(row, tip, axis, tip_to, axis_to, tip_off_mm, axis_off_deg)
