"""How long a run of blocks takes at feed: look-ahead within the accelerations and jerks of the axes.

Time is counted as `u`, the time at full rate; the rate r = du/dt, at most 1, is how fast the run is driven. An axis
whose velocity is w(u) at full rate then has the velocity w r, the acceleration w' r² + w r dr/du, and a jerk of w'' r³
and terms of the change of r. What the blocks ask for (w', w'') limits the rate at their ends; what is left, the change
of the rate, is driven with the greatest acceleration that the axes allow, and rounded off by their jerk."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..base import Floats, Integers
from .rate_humps import Humps, Side

# A block shorter than this (seconds) is none: its tip and axes stand still.
NO_TIME_S = 1e-12
# Rates that differ by no more are the same.
SAME_RATE = 1e-9
# A rise of the rate inside of a block by less than this part of it is not worth its jerks.
WORTH = 0.01


@dataclass(frozen=True)
class Drives:
    """What the five axes and the control of a machine allow."""

    velocity: Floats  # (5,) greatest, mm/s or degrees/s
    acceleration: Floats  # (5,) greatest, per second
    settle: Floats  # (5,) seconds: acceleration / greatest jerk, 0 where it has no limit
    block_s: float  # the control takes no less for a block
    stops: bool  # at the end of every block


def run_seconds(steady: Floats, way: Floats, drives: Drives) -> Floats:
    """Seconds (N,) of the blocks of one run from rest to rest, which would take `steady` (N,) seconds at full rate.

    way: (N, 5) of the axes in each block, mm or degrees."""
    moving = np.flatnonzero(steady > NO_TIME_S)
    seconds = np.full(len(steady), drives.block_s)
    if len(moving):
        times = np.maximum(steady[moving], drives.block_s)
        velocity = way[moving] / times[:, None]
        with np.errstate(divide="ignore"):
            slopes = drives.acceleration / np.abs(velocity)
        slope, settle = slopes.min(axis=1), drives.settle[slopes.argmin(axis=1)]
        rates = _rates(times, slope, corner_rates(times, velocity, drives))
        blocks = _driven(times, slope, settle, rates)
        seconds[moving] = _rounded_seconds(blocks) if settle.any() else blocks.seconds
    return seconds


def corner_rates(times: Floats, velocity: Floats, drives: Drives) -> Floats:
    """(N + 1,) greatest rates at the ends of the blocks: at rest outside, else as the axes allow their velocities (N, 5)
    to change within half of both blocks, and these changes to begin and end within a block."""
    most = np.zeros(len(times) + 1)
    if drives.stops:
        return most
    around = 0.5 * (times[:-1] + times[1:])[:, None]
    # at full rate, in units of the greatest acceleration and jerk; the one goes with r², the other with r³
    accelerations = np.diff(velocity, axis=0) / around / drives.acceleration
    jerks = np.diff(accelerations, axis=0, prepend=0.0, append=0.0) * drives.settle / times[:, None]
    with np.errstate(divide="ignore"):
        by_corner = 1 / np.sqrt(np.abs(accelerations).max(axis=1))
        by_block = 1 / np.cbrt(np.abs(jerks).max(axis=1))
    most[1:-1] = np.minimum(np.minimum(by_corner, 1.0), np.minimum(by_block[:-1], by_block[1:]))
    return most


def _rates(times: Floats, slope: Floats, most: Floats) -> Floats:
    """The greatest rates (N + 1,) at the ends of the blocks that `slope` allows, forwards and backwards."""
    squares, gains = (most**2).tolist(), (2.0 * slope * times).tolist()
    for i, gain in enumerate(gains):
        squares[i + 1] = min(squares[i + 1], squares[i] + gain)
    for i in range(len(gains) - 1, -1, -1):
        squares[i] = min(squares[i], squares[i + 1] + gains[i])
    return np.array([math.sqrt(square) for square in squares])


@dataclass(frozen=True)
class _Blocks:
    """How the blocks (N,) of a run are driven without regard to jerk: up from one rate, on at 1, down to the other."""

    u: Floats  # seconds at full rate
    rate: Floats  # (N + 1,) at their ends
    peak: Floats
    up: Floats  # seconds that the rate rises, stays, falls
    on: Floats
    down: Floats
    ease: Floats  # seconds², 1 / greatest jerk of the rate

    @property
    def seconds(self) -> Floats:
        return np.asarray(self.up + self.on + self.down)

    @property
    def lows(self) -> Integers:
        """First blocks of the stretches from one lowest rate to the next."""
        falls = self.peak[:-1] > self.rate[1:-1] + SAME_RATE
        rises = self.peak[1:] > self.rate[1:-1] + SAME_RATE
        return np.flatnonzero(np.append(True, falls & rises))


def _driven(u: Floats, slope: Floats, settle: Floats, rate: Floats) -> _Blocks:
    start, end = rate[:-1], rate[1:]
    peak = np.minimum(np.sqrt(0.5 * (start**2 + end**2) + slope * u), 1.0)
    up, down = (peak - start) / slope, (peak - end) / slope
    on = np.maximum(u - 0.5 * ((peak + start) * up + (peak + end) * down), 0.0) / peak
    return _Blocks(u, rate, peak, up, on, down, settle / slope)


def _flattened(blocks: _Blocks) -> _Blocks:
    """Without the rise and fall inside of blocks for which the jerk leaves no time: there the rate goes evenly from one
    end to the other. What is left of many short blocks is the rise and fall of their ends."""
    start, end = blocks.rate[:-1], blocks.rate[1:]
    least = np.maximum(start, end)
    # The rate gained in half of a time T with jerk is T² / 16 of the greatest jerk.
    seconds = blocks.u / np.where(least > 0, least, 1.0)
    hump = (least > 0) & (blocks.peak > least + SAME_RATE)
    flat = hump & (seconds**2 < 16 * WORTH * least * blocks.ease)
    even = 2 * blocks.u / np.where(flat, start + end, 1.0)
    return _Blocks(
        u=blocks.u,
        rate=blocks.rate,
        peak=np.where(flat, least, blocks.peak),
        up=np.where(flat, even * (end > start), blocks.up),
        on=np.where(flat, even * (end == start), blocks.on),
        down=np.where(flat, even * (end < start), blocks.down),
        ease=blocks.ease,
    )


def _rounded_seconds(blocks: _Blocks) -> Floats:
    """Seconds (N,) of the blocks with their ramps rounded off by the jerk of the axes."""
    blocks = _flattened(blocks)
    first = blocks.lows
    count = np.diff(np.append(first, len(blocks.u)))
    start, end = blocks.rate[first], blocks.rate[np.append(first[1:], len(blocks.u))]
    peak = np.maximum.reduceat(blocks.peak, first)
    humps = Humps(
        np.add.reduceat(blocks.u, first),
        peak,
        Side.of(start, peak, *_ramp_of(blocks, blocks.up, blocks.rate[:-1], first)),
        Side.of(end, peak, *_ramp_of(blocks, blocks.down, blocks.rate[1:], first)),
    )
    stretch = humps.seconds() / np.add.reduceat(blocks.seconds, first)
    return np.asarray(blocks.seconds * np.repeat(stretch, count))


def _ramp_of(blocks: _Blocks, seconds: Floats, low: Floats, first: Integers) -> tuple[Floats, Floats, Floats]:
    """Seconds, u and mean ease of one side of each hump."""
    total = np.add.reduceat(seconds, first)
    u = np.add.reduceat(0.5 * (blocks.peak + low) * seconds, first)
    ease = np.add.reduceat(blocks.ease * seconds, first) / np.where(total > 0, total, 1.0)
    return total, u, ease
