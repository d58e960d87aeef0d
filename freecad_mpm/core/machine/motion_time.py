"""How long a machine takes for its moves, with the feeds, and the velocities, accelerations and jerks of its axes.

Feed moves are driven as a control with look-ahead does: as fast as feed and axes allow, through a corner no faster
than the axes can change their velocities within half of the two blocks, and never faster than they can slow down for
what comes. A control's own smoothing within a tolerance is not known to this."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from ..base import Floats
from .axis_ramps import rest_to_rest_seconds
from .feed_profile import Drives, run_seconds
from .machine import Machine
from .moves import Moves

SECONDS_PER_MINUTE = 60.0
MS_PER_SECOND = 1000.0
SLOWED = 2.0


def move_seconds(machine: Machine, moves: Moves, linear_mm: Floats, blends: bool = False) -> Floats:
    """Seconds of each move (M,); linear_mm: (M, 3) readings of X, Y and Z. blends: the program lets the control round
    its corners, so that it stops at the end of no block.

    Rapids start and end at rest; so does each run of feed moves between two of them."""
    way = np.diff(np.hstack((linear_mm, moves.rotary_deg)), axis=0, prepend=np.nan)
    way[0] = 0.0
    drives = drives_of(machine, blends)
    rapid = moves.is_rapid
    alone = rest_to_rest_seconds(np.abs(way), drives.velocity, drives.acceleration, drives.settle)
    seconds = np.where(rapid, np.maximum(alone.max(axis=1), drives.block_s), 0.0)
    for start, stop in _runs(~rapid):
        run = slice(start, stop)
        feed = moves.feed_mm_per_min[run] / SECONDS_PER_MINUTE
        tip = np.linalg.norm(np.diff(moves.tip[max(start - 1, 0) : stop], axis=0), axis=1)
        tip = tip if start else np.append(0.0, tip)
        steady = np.maximum(tip / feed, (np.abs(way[run]) / drives.velocity).max(axis=1))
        seconds[run] = run_seconds(steady, way[run], drives)
    return seconds


def slowed_cuts(machine: Machine, moves: Moves) -> NDArray[np.int64]:
    """Rows of cuts in which a rotary axis at its greatest velocity takes more than SLOWED times as long as the tip at
    its feed: the feed drops there, most of all near the pole."""
    turn = np.abs(np.diff(moves.rotary_deg, axis=0, prepend=moves.rotary_deg[:1]))
    velocity = np.array([axis.max_velocity_deg_per_min for axis in machine.rotary_axes])
    way = np.linalg.norm(np.diff(moves.tip, axis=0, prepend=moves.tip[:1]), axis=1)
    cutting = moves.kind == "cut"
    tip_minutes = way / np.where(cutting, moves.feed_mm_per_min, np.inf)
    return np.flatnonzero(cutting & ((turn / velocity).max(axis=1) > SLOWED * tip_minutes))


def drives_of(machine: Machine, blends: bool = False) -> Drives:
    """What the machine file says of the axes, X, Y, Z and the rotary ones, and of the control; as for `move_seconds`."""
    linear = [
        (one.max_velocity_mm_per_min, one.max_acceleration_mm_per_s2, one.max_jerk_mm_per_s3)
        for one in machine.linear_axes
    ]
    rotary = [
        (one.max_velocity_deg_per_min, one.max_acceleration_deg_per_s2, one.max_jerk_deg_per_s3)
        for one in machine.rotary_axes
    ]
    velocity, acceleration, jerk = np.array(linear + rotary).T
    return Drives(
        velocity=velocity / SECONDS_PER_MINUTE,
        acceleration=acceleration,
        settle=acceleration / jerk,
        block_s=machine.control.block_time_ms / MS_PER_SECOND,
        stops=machine.control.stops_at_blocks and not blends,
    )


def _runs(at_feed: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First and behind the last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.pad(at_feed, 1).astype(np.int8)))
    return zip(edges[::2].tolist(), edges[1::2].tolist())
