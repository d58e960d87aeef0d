"""The rate of a run from a lowest value up to a greatest and down to the next lowest, its ramps rounded off by jerk."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..base import Floats
from .axis_ramps import ramp_seconds

# Halvings of the rates between which one is searched.
BISECTIONS = 40


@dataclass
class Side:
    """The rise, or the fall read backwards, of humps (H,): as driven without jerk, and how it is rounded off."""

    low: Floats  # its lowest rate
    gain: Floats  # of the rate a second
    settle: Floats  # seconds until that is reached
    share: Floats  # its u as a part of what an even ramp takes: ramps over several blocks are not even

    @classmethod
    def of(cls, low: Floats, peak: Floats, seconds: Floats, u: Floats, ease: Floats) -> Side:
        """seconds, u: without jerk; ease: seconds², 1 / greatest jerk of the rate."""
        ramps = seconds > 0
        some = np.where(ramps, seconds, 1.0)
        gain = np.where(ramps & (peak > low), (peak - low) / some, 1.0)
        even = 0.5 * (peak + low) * some
        return cls(low.copy(), gain, gain * ease, np.where(ramps, u / even, 1.0))

    def seconds(self, peak: Floats) -> Floats:
        """(H,) that it takes up to the rates `peak` (H,); 0 where these are not above its lowest."""
        change = np.maximum(peak - self.low, 0.0)
        return np.where(change > 0, ramp_seconds(change, self.gain, self.settle), 0.0)

    def u(self, peak: Floats) -> Floats:
        """(H,) the way up to the rates `peak` (H,), in seconds at full rate."""
        return np.asarray(0.5 * (peak + self.low) * self.share * self.seconds(peak))

    def at(self, hump: int) -> Side:
        """This side of one hump alone, as arrays (1,)."""
        return Side(*(column[hump : hump + 1] for column in (self.low, self.gain, self.settle, self.share)))


@dataclass
class Humps:
    """All humps of a run, one a row; rates as parts of the full one. Timing them may lower their lowest rates."""

    u: Floats  # (H,) seconds at full rate
    peak: Floats  # (H,) greatest rate without jerk
    rise: Side
    fall: Side

    def seconds(self) -> Floats:
        """Seconds (H,): a peak is lower where there is no room for its ramps, and so is a lowest rate from which the
        next cannot be reached."""
        low = np.maximum(self.rise.low, self.fall.low)
        if (self._ramps(low) > self.u).any():
            self._lower_lows()
            low = np.maximum(self.rise.low, self.fall.low)
        peak = _greatest(lambda rate: self._ramps(rate) <= self.u, low, self.peak)
        steady = np.maximum(self.u - self._ramps(peak), 0.0) / peak
        return np.asarray(self.rise.seconds(peak) + self.fall.seconds(peak) + steady)

    def _ramps(self, peak: Floats) -> Floats:
        return self.rise.u(peak) + self.fall.u(peak)

    def _lower_lows(self) -> None:
        """Forwards and backwards."""
        rise, fall = self.rise, self.fall
        for k in range(len(self.u)):
            fall.low[k] = self._reached(k, rise, fall.low[k])
            rise.low[k + 1 : k + 2] = fall.low[k]
        for k in range(len(self.u) - 1, -1, -1):
            rise.low[k] = self._reached(k, fall, rise.low[k])
            fall.low[k - 1 : k] = rise.low[k]

    def _reached(self, hump: int, side: Side, most: float) -> float:
        """The greatest rate up to `most` that one side alone reaches within its hump."""
        one, room = side.at(hump), self.u[hump]
        if most <= one.low[0] or one.u(np.array([most]))[0] <= room:
            return most
        return float(_greatest(lambda rate: one.u(rate) <= room, one.low, np.array([most]))[0])


def _greatest(fits: Callable[[Floats], NDArray[np.bool_]], low: Floats, high: Floats) -> Floats:
    """The greatest rates from low to high that fit; low where none does."""
    low = np.where(fits(high), high, low)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        good = fits(middle)
        low, high = np.where(good, middle, low), np.where(good, high, middle)
    return low
