"""Proving the moves between positions: every cut is certified; where it is not free, positions are put in between.

The tolerance of a cut is the chord tolerance. A share of it is given away to the control, whose rotary axes run evenly
and so leave the great circle; the certificate takes that share off again at the full length of the lever. A control that
does not hold the tip has as much again for the tip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import numpy as np

from ..base import Flags, Floats, Integers, Stages
from ..job import PROVEN, Job, cut_depth_mm
from ..part import Scene
from ..positioning import Positions
from .certify import certify

# A move is halved so many times at most: to a sixteenth. What is not free then leads over a jump of the axis.
DEPTH = 4

Place = Callable[[Floats, Floats], Positions]


@dataclass(frozen=True)
class Proven:
    """N positions, those put in between included, and the moves that end in them."""

    positions: Positions
    cut_clearance: Floats  # (N,) mm, proven for the move from the position before; NaN: none, or not free
    cells: int  # pairs of surface piece and time interval bounded


def prove(
    job: Job, scene: Scene, points: Floats, positions: Positions, place: Place, stages: Stages
) -> Proven:
    """Certify the moves along the passes and put positions in between until they are free, all in the set-up frame.

    points: (N, 2) where in plan the positions stand. place: gives the positions over further points (M, 2) with the
    spins (M,) in degrees."""
    rows = _Rows(points, positions, np.full(len(points), np.nan))
    open_moves, depth_mm = positions.neighbours, cut_depth_mm(job.tolerance, PROVEN)
    cells = 0
    for depth in range(DEPTH + 1):
        found = certify(
            job, scene, rows.positions.tip, rows.positions.axis, np.flatnonzero(open_moves), depth_mm, stages
        )
        rows.clearance[open_moves] = np.where(found.verdict == "free", found.lo, np.nan)
        cells += int(found.cells.sum())
        failed = open_moves & np.isnan(rows.clearance)
        if depth == DEPTH or not failed.any():
            break
        rows, open_moves = _halve(rows, failed, place)
    rows = _without_loners(rows)
    return Proven(rows.positions, rows.clearance, cells)


@dataclass(frozen=True)
class _Rows:
    points: Floats  # (N, 2)
    positions: Positions
    clearance: Floats  # (N,)


def _halve(rows: _Rows, failed: Flags, place: Place) -> tuple[_Rows, Flags]:
    """A position in the middle of each failed move, where there is one; and which moves are new for it."""
    before = np.flatnonzero(failed)
    points = 0.5 * (rows.points[before - 1] + rows.points[before])
    spin_deg = rows.positions.spin_deg
    middles = place(points, middle_angle_deg(spin_deg[before - 1], spin_deg[before]))
    middles = replace(
        middles, pass_index=rows.positions.pass_index[before], inserted=np.ones(len(before), bool)
    )
    keep = middles.usable
    added = _Rows(points, middles, np.full(len(before), np.nan))
    at = np.concatenate((np.arange(len(rows.points)), before[keep] - 0.5))
    which = np.concatenate((np.arange(len(rows.points)), len(rows.points) + np.flatnonzero(keep)))[
        np.argsort(at, kind="stable")
    ]
    new = which >= len(rows.points)
    new[1:] |= new[:-1]  # the moves to an inserted position and from it
    return _select(_joined(rows, added), which), new


def middle_angle_deg(a: Floats, b: Floats) -> Floats:
    """Half-way from a to b on the shorter way round, in [-180, 180)."""
    turn = (b - a + 180.0) % 360.0 - 180.0
    middle: Floats = (a + turn / 2 + 180.0) % 360.0 - 180.0
    return middle


def _without_loners(rows: _Rows) -> _Rows:
    """Without the inserted positions that no proven move leads to or from: they would be plunged into for nothing."""
    proven = np.isfinite(rows.clearance)
    leaves = np.append(proven[1:], False)
    return _select(rows, np.flatnonzero(~rows.positions.inserted | proven | leaves))


def _joined(a: _Rows, b: _Rows) -> _Rows:
    columns = {
        one.name: np.concatenate((getattr(a.positions, one.name), getattr(b.positions, one.name)))
        for one in fields(Positions)
    }
    return _Rows(
        np.concatenate((a.points, b.points)),
        Positions(**columns),
        np.concatenate((a.clearance, b.clearance)),
    )


def _select(rows: _Rows, which: Integers) -> _Rows:
    columns = {one.name: getattr(rows.positions, one.name)[which] for one in fields(Positions)}
    return _Rows(rows.points[which], Positions(**columns), rows.clearance[which])
