"""How long a machine takes for its moves, with the feeds, and the velocities and accelerations of its axes.

Feed moves are driven as a control with look-ahead does: as fast as feed and axes allow, through a corner no faster
than the axes can change their velocities within half of the two blocks, and never faster than they can slow down for
what comes. Jerk and the control's own smoothing are not known to this."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .machines import Machine
from .posts.program import Moves

Floats = NDArray[np.float64]

SECONDS_PER_MINUTE = 60.0
# A feed move shorter than this (seconds) is none: its tip and axes stand still.
NO_TIME_S = 1e-12
SLOWED = 2.0


def move_seconds(machine: Machine, moves: Moves, linear_mm: Floats) -> Floats:
    """Seconds of each move (M,); linear_mm: (M, 3) readings of X, Y and Z.

    Rapids start and end at rest; so does each run of feed moves between two of them."""
    way = np.diff(np.hstack((linear_mm, moves.angles_deg)), axis=0, prepend=np.nan)
    way[0] = 0.0
    velocity, acceleration = _limits(machine)
    rapid = moves.is_rapid
    seconds = np.where(rapid, _rest_to_rest(np.abs(way), velocity, acceleration).max(axis=1), 0.0)
    for start, stop in _runs(~rapid):
        run = slice(start, stop)
        feed = moves.feed_mm_per_min[run] / SECONDS_PER_MINUTE
        tip = np.linalg.norm(np.diff(moves.tip[max(start - 1, 0) : stop], axis=0), axis=1)
        tip = tip if start else np.append(0.0, tip)
        steady = np.maximum(tip / feed, (np.abs(way[run]) / velocity).max(axis=1))
        seconds[run] = _run_seconds(steady, way[run], acceleration)
    return seconds


def slowed_cuts(machine: Machine, moves: Moves) -> NDArray[np.int64]:
    """Rows of cuts in which a rotary axis at its greatest velocity takes more than SLOWED times as long as the tip at
    its feed: the feed drops there, most of all near the pole."""
    turn = np.abs(np.diff(moves.angles_deg, axis=0, prepend=moves.angles_deg[:1]))
    velocity = np.array([axis.max_velocity_deg_per_min for axis in machine.rotary_axes])
    way = np.linalg.norm(np.diff(moves.tip, axis=0, prepend=moves.tip[:1]), axis=1)
    cutting = moves.kind == "cut"
    tip_minutes = way / np.where(cutting, moves.feed_mm_per_min, np.inf)
    return np.flatnonzero(cutting & ((turn / velocity).max(axis=1) > SLOWED * tip_minutes))


def _limits(machine: Machine) -> tuple[Floats, Floats]:
    """(5,) greatest velocities (per second) and accelerations of X, Y, Z and the rotary axes."""
    linear = [(one.max_velocity_mm_per_min, one.max_acceleration_mm_per_s2) for one in machine.linear_axes]
    rotary = [(one.max_velocity_deg_per_min, one.max_acceleration_deg_per_s2) for one in machine.rotary_axes]
    velocity, acceleration = np.array(linear + rotary).T
    return velocity / SECONDS_PER_MINUTE, acceleration


def _rest_to_rest(way: Floats, velocity: Floats, acceleration: Floats) -> Floats:
    """Seconds for ways from rest to rest: d / v + v / a, or 2 sqrt(d / a) when v is not reached on the way d."""
    short = way * acceleration < velocity**2
    return np.where(short, 2 * np.sqrt(way / acceleration), way / velocity + velocity / acceleration)


def _runs(at_feed: NDArray[np.bool_]) -> Iterator[tuple[int, int]]:
    """First and behind the last index of each run of true values."""
    edges = np.flatnonzero(np.diff(np.pad(at_feed, 1).astype(np.int8)))
    return zip(edges[::2].tolist(), edges[1::2].tolist())


def _run_seconds(steady: Floats, way: Floats, acceleration: Floats) -> Floats:
    """Seconds of the blocks (N,) of one run from rest to rest, which would take `steady` seconds at full rate.

    The rate r, at most 1, is how fast the run is driven of its full rate; with u the time at full rate an axis of
    velocity w accelerates by w r dr/du, so that r² grows with u by at most 2 a / w."""
    moving = np.flatnonzero(steady > NO_TIME_S)
    seconds = np.zeros(len(steady))
    if len(moving):
        times, velocity = steady[moving], way[moving] / steady[moving][:, None]
        with np.errstate(divide="ignore"):
            slope = (acceleration / np.abs(velocity)).min(axis=1)  # of r² / 2
        rate = _rates(times, slope, _corner_rates(times, velocity, acceleration))
        seconds[moving] = _block_seconds(times, slope, rate[:-1], rate[1:])
    return seconds


def _corner_rates(times: Floats, velocity: Floats, acceleration: Floats) -> Floats:
    """(N + 1,) greatest rates at the ends of the blocks: at rest outside, else as the axes' change of velocity
    allows."""
    change = np.abs(np.diff(velocity, axis=0))
    with np.errstate(divide="ignore"):
        allowed = (acceleration * 0.5 * (times[:-1] + times[1:])[:, None] / change).min(axis=1)
    return np.concatenate(([0.0], np.minimum(np.sqrt(allowed), 1.0), [0.0]))


def _rates(times: Floats, slope: Floats, most: Floats) -> Floats:
    """The greatest rates (N + 1,) at the ends of the blocks that `slope` allows, forwards and backwards."""
    squares, gains = (most**2).tolist(), (2.0 * slope * times).tolist()
    for i, gain in enumerate(gains):
        squares[i + 1] = min(squares[i + 1], squares[i] + gain)
    for i in range(len(gains) - 1, -1, -1):
        squares[i] = min(squares[i], squares[i + 1] + gains[i])
    return np.array([math.sqrt(square) for square in squares])


def _block_seconds(times: Floats, slope: Floats, start: Floats, end: Floats) -> Floats:
    """Up from one rate, on at the greatest there is time for, and down to the other."""
    peak = np.minimum(np.sqrt(0.5 * (start**2 + end**2) + slope * times), 1.0)
    ramps = (2 * peak - start - end) / slope
    steady = np.maximum(times - (2 * peak**2 - start**2 - end**2) / (2 * slope), 0.0) / peak
    return np.asarray(ramps + steady)
