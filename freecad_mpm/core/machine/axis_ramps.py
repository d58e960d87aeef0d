"""Ramps of one velocity to another under a greatest acceleration and jerk: seconds and ways in closed form.

A ramp starts and ends without acceleration: jerk up, on at the greatest acceleration when there is time for that, jerk
down, symmetrical in time. Such ramps, with a steady stretch between two of them, are the seven-phase profile of controls
(Biagiotti, Melchiorri: Trajectory Planning for Automatic Machines and Robots, 2008, sections 3.3 and 3.4). An infinite
jerk makes them the trapezoid. `settle` is the time to reach the greatest acceleration: acceleration / jerk."""

from __future__ import annotations

import numpy as np

from ..base import Floats


def ramp_seconds(change: Floats, acceleration: Floats, settle: Floats) -> Floats:
    """Seconds of ramps by `change` >= 0 of the velocity: c / a + s, or 2 sqrt(c s / a) when a is not reached."""
    steady = change / acceleration
    return np.asarray(np.where(steady >= settle, steady + settle, 2 * np.sqrt(steady * settle)))


def rest_to_rest_seconds(way: Floats, velocity: Floats, acceleration: Floats, settle: Floats) -> Floats:
    """Seconds for ways >= 0 from rest to rest: up, steady at the velocity when it is reached, down."""
    whole = velocity * ramp_seconds(velocity, acceleration, settle)  # the way of both full ramps
    peak = np.minimum(_peak(way, acceleration, settle), velocity)
    return np.asarray(
        np.where(
            way >= whole,
            way / velocity + ramp_seconds(velocity, acceleration, settle),
            2 * ramp_seconds(peak, acceleration, settle),
        )
    )


def _peak(way: Floats, acceleration: Floats, settle: Floats) -> Floats:
    """The velocity v that two ramps reach on a way from rest to rest: v ramp_seconds(v) = way."""
    with_steady = acceleration * (np.sqrt(settle**2 + 4 * way / acceleration) - settle) / 2
    with np.errstate(divide="ignore", invalid="ignore"):
        without = np.cbrt(way**2 * acceleration / (4 * settle))
    return np.where(with_steady >= acceleration * settle, with_steady, without)
