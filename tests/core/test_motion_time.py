"""The time of moves: closed forms of straight lines, corners, circles and turns."""

import time

import numpy as np
import pytest
from machine_samples import directions

from freecad_mpm.core import kinematics, machines
from freecad_mpm.core.machine_path import machine_path
from freecad_mpm.core.motion_time import move_seconds, slowed_cuts

# 500 mm/s and 5000 mm/s2 along X, Y and Z; 120 deg/s and 360 deg/s2 of both rotary axes
MACHINE = "table_bc"
LINEAR, ROTARY = 5000.0, (120.0, 360.0)


def seconds_of(tip, axis, feed_mm_per_s, kind=None):
    machine, count = machines.load(MACHINE), len(tip)
    kind = np.array(["rapid"] + ["cut"] * (count - 1)) if kind is None else kind
    moves = machine_path(
        machine,
        kind,
        np.array(tip, float),
        axis,
        np.full(count, 60.0 * feed_mm_per_s),
        axis_tolerance_deg=180.0,
    )
    linear = kinematics.linear_readings(machine, moves.tip, moves.angles_deg, np.zeros(3), 150.0)
    return move_seconds(machine, moves, linear)


def upright(count):
    return directions(np.zeros(count), np.zeros(count))


def straight(length, blocks):
    return np.column_stack((np.linspace(0, length, blocks + 1), np.zeros((blocks + 1, 2))))


@pytest.mark.parametrize("blocks", [1, 7, 100])
@pytest.mark.parametrize("feed", [10.0, 100.0])
def test_a_straight_line_starts_and_ends_at_rest_in_however_many_blocks(blocks, feed):
    length = 60.0
    assert seconds_of(straight(length, blocks), upright(blocks + 1), feed).sum() == pytest.approx(
        length / feed + feed / LINEAR, rel=1e-9
    )


def test_a_line_too_short_for_its_feed():
    assert seconds_of(straight(0.5, 3), upright(4), 400.0).sum() == pytest.approx(
        2 * np.sqrt(0.5 / LINEAR), rel=1e-9
    )


def test_a_reversal_nearly_stops():
    """There and back: the axis has to change its velocity by twice the feed."""
    there = [(0, 0, 0), (50, 0, 0), (0, 0, 0)]
    alone = 2 * (50 / 300.0 + 300.0 / LINEAR)
    # the corner may be taken within half of both blocks' time
    assert alone * 0.5 < seconds_of(there, upright(3), 300.0).sum() <= alone
    fine = np.concatenate((straight(50, 500), straight(50, 500)[-2::-1]))
    assert seconds_of(fine, upright(len(fine)), 300.0).sum() == pytest.approx(alone, rel=0.03)


def seconds_round(feed):
    turns, radius = 5, 5.0
    angle = np.linspace(0, 2 * np.pi * turns, 3600)
    circle = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), np.zeros(len(angle))))
    return seconds_of(circle, upright(len(circle)), feed).sum(), 2 * np.pi * radius * turns


def test_a_circle_is_driven_at_its_feed_where_its_curvature_allows():
    seconds, way = seconds_round(20.0)
    assert seconds == pytest.approx(way / 20.0 + 20.0 / LINEAR, rel=1e-3)


def test_a_circle_is_driven_no_faster_than_its_curvature_allows():
    """v² / R <= a where one axis alone bends the way, and sqrt(2) a where two do: 158 to 188 mm/s at R = 5 mm."""
    seconds, way = seconds_round(400.0)
    least = np.sqrt(LINEAR * 5.0)
    assert way / (2**0.25 * least) < seconds < way / least


def test_a_turn_takes_the_rotary_axis_time():
    velocity, acceleration = ROTARY
    seconds = seconds_of([(0, 0, 0), (0.001, 0, 0)], directions(20.0, [0.0, 90.0]), 50.0)
    assert seconds.sum() == pytest.approx(90.0 / velocity + velocity / acceleration, rel=1e-2)


def test_cuts_that_a_rotary_axis_slows_down_are_named():
    """1 mm at 50 mm/s takes 0.02 s, in which 120 deg/s turn 2.4 degrees."""
    machine, turns = machines.load(MACHINE), np.array([0.0, 2.0, 6.9, 6.9])  # steps of 2, 4.9 and 0 degrees
    kind = np.array(["rapid", "cut", "cut", "cut"])
    moves = machine_path(
        machine, kind, straight(3.0, 3), directions(20.0, turns), np.full(4, 3000.0), axis_tolerance_deg=180.0
    )
    assert slowed_cuts(machine, moves).tolist() == [2]


def test_rapids_stop_between_feed_moves():
    tip = straight(30.0, 3)
    kind = np.array(["rapid", "cut", "rapid", "cut"])
    seconds = seconds_of(tip, upright(4), 100.0, kind)
    cut = 10 / 100.0 + 100.0 / LINEAR
    assert seconds == pytest.approx([0.0, cut, 2 * np.sqrt(10 / LINEAR), cut], rel=1e-9)


def test_a_hundred_thousand_blocks_take_under_two_seconds():
    angle = np.linspace(0, 500, 100_000)
    tip = np.column_stack((50 * np.cos(angle), 50 * np.sin(angle), angle / 10))
    started = time.process_time()
    seconds_of(tip, upright(len(tip)), 50.0)
    assert time.process_time() - started < 4.0
