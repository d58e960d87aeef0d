"""The time of moves: closed forms of straight lines, corners, circles and turns, with jerk and without."""

from dataclasses import replace

import numpy as np
import pytest
from machine_samples import directions
from speed import formatting_s, worked_s

from freecad_mpm.core import machine as machines
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control import kinematics
from freecad_mpm.core.machine import joint_path, move_seconds, slowed_cuts
from freecad_mpm.core.machine.axis_ramps import ramp_seconds, rest_to_rest_seconds
from freecad_mpm.core.machine.machine import MachineControl

# 500 mm/s and 5000 mm/s2 along X, Y and Z; 120 deg/s and 360 deg/s2 of both rotary axes
MACHINE = "table_bc"
LINEAR, ROTARY = 5000.0, (120.0, 360.0)
JERK = 50_000.0  # mm/s3: 5000 mm/s2 are reached in 0.1 s


def with_jerk(jerk=JERK, **control):
    """The machine with a jerk for X, Y and Z, and a control of its own."""
    machine = machines.load(MACHINE)
    axes = tuple(replace(axis, max_jerk_mm_per_s3=jerk) for axis in machine.linear_axes)
    return replace(machine, linear_axes=axes, control=MachineControl(**control))


def seconds_of(tip, axis, feed_mm_per_s, kind=None, machine=None):
    return move_seconds(machine or machines.load(MACHINE), *moves_of(tip, axis, feed_mm_per_s, kind))


def moves_of(tip, axis, feed_mm_per_s, kind=None):
    """The moves of the machine, and the readings of X, Y and Z."""
    machine, count = machines.load(MACHINE), len(tip)
    kind = np.array(["rapid"] + ["cut"] * (count - 1)) if kind is None else kind
    moves = joint_path(
        machine,
        kind,
        np.array(tip, float),
        axis,
        np.full(count, 60.0 * feed_mm_per_s),
        axis_tolerance_deg=180.0,
    )
    linear = kinematics.linear_readings(machine, moves.tip, moves.rotary_deg, np.zeros(3), 150.0)
    return moves, linear


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


def seconds_round(feed, machine=None, blocks=3600):
    turns, radius = 5, 5.0
    angle = np.linspace(0, 2 * np.pi * turns, blocks)
    circle = np.column_stack((radius * np.cos(angle), radius * np.sin(angle), np.zeros(len(angle))))
    return seconds_of(circle, upright(len(circle)), feed, None, machine).sum(), 2 * np.pi * radius * turns


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
    moves = joint_path(
        machine, kind, straight(3.0, 3), directions(20.0, turns), np.full(4, 3000.0), axis_tolerance_deg=180.0
    )
    assert slowed_cuts(machine, moves).tolist() == [2]


def test_rapids_stop_between_feed_moves():
    tip = straight(30.0, 3)
    kind = np.array(["rapid", "cut", "rapid", "cut"])
    seconds = seconds_of(tip, upright(4), 100.0, kind)
    cut = 10 / 100.0 + 100.0 / LINEAR
    assert seconds == pytest.approx([0.0, cut, 2 * np.sqrt(10 / LINEAR), cut], rel=1e-9)


def test_a_hundred_thousand_blocks_take_about_as_long_as_making_text_of_their_numbers():
    angle = np.linspace(0, 500, 100_000)
    tip = np.column_stack((50 * np.cos(angle), 50 * np.sin(angle), angle / 10))
    assert worked_s(lambda: seconds_of(tip, upright(len(tip)), 50.0)) < 5 * formatting_s(500_000)


def s_curve(way, velocity, acceleration, jerk):
    """Seconds from rest to rest on the textbook's seven phases, by the phases themselves: jerk up, steady, jerk down."""
    low, high = 0.0, velocity
    for _ in range(200):  # the velocity that is reached, by halving
        peak = 0.5 * (low + high)
        low, high = (peak, high) if 2 * sum(ramp_phases(peak, acceleration, jerk)[1]) <= way else (low, peak)
    seconds, ways = ramp_phases(low, acceleration, jerk)
    return 2 * sum(seconds) + (way - 2 * sum(ways)) / low


def ramp_phases(velocity, acceleration, jerk):
    """Seconds and ways of the three phases from rest to a velocity, each by integrating its own polynomial."""
    reached = min(acceleration, np.sqrt(velocity * jerk))
    first, second = reached / jerk, velocity / reached - reached / jerk
    v1, v2 = reached * first / 2, velocity - reached * first / 2
    ways = [jerk * first**3 / 6, v1 * second + reached * second**2 / 2]
    ways.append(v2 * first + reached * first**2 / 2 - jerk * first**3 / 6)
    return [first, second, first], ways


@pytest.mark.parametrize("jerk", [1e3, 1e5, 1e9])
@pytest.mark.parametrize("way", [0.01, 1.0, 40.0, 1000.0])
def test_ways_from_rest_to_rest_have_their_seven_phases(way, jerk):
    velocity, acceleration = np.array([500.0]), np.array([5000.0])
    found = rest_to_rest_seconds(np.array([way]), velocity, acceleration, acceleration / jerk)
    assert found == pytest.approx(s_curve(way, 500.0, 5000.0, jerk), rel=1e-9)


def test_without_a_limit_of_the_jerk_the_profile_is_a_trapezoid():
    one, never = np.ones(1), np.zeros(1)
    assert rest_to_rest_seconds(9 * one, 2 * one, 4 * one, never) == pytest.approx(9 / 2 + 2 / 4)
    assert rest_to_rest_seconds(0.25 * one, 2 * one, 4 * one, never) == pytest.approx(2 * np.sqrt(0.25 / 4))
    assert ramp_seconds(2 * one, 4 * one, never) == pytest.approx(0.5)


@pytest.mark.parametrize("blocks", [1, 7, 100])
def test_a_straight_line_takes_its_s_curve_in_however_many_blocks(blocks):
    for length, feed in ((60.0, 100.0), (60.0, 400.0), (0.5, 400.0)):
        seconds = seconds_of(straight(length, blocks), upright(blocks + 1), feed, None, with_jerk())
        assert seconds.sum() == pytest.approx(s_curve(length, feed, LINEAR, JERK), rel=1e-6)


def test_a_circle_is_driven_no_faster_than_the_jerk_of_its_curvature_allows():
    """v³ / R² <= j where one axis alone bends the way, 2^(1/2) j where two do: 108 to 121 mm/s at R = 5 mm."""
    seconds, way = seconds_round(400.0, with_jerk())
    least = np.cbrt(JERK * 5.0**2)
    assert way / (2 ** (1 / 6) * least) < seconds < way / least * 1.02
    assert seconds_round(400.0, with_jerk(), 7200)[0] == pytest.approx(seconds, rel=0.01)


def test_the_harder_an_axis_may_jerk_the_sooner_it_is_done_down_to_the_time_without_a_limit():
    angle = np.linspace(0, 40, 400)
    tip = np.column_stack((angle, 8 * np.sin(angle) ** 3, np.abs(np.sin(2 * angle))))
    seconds = [
        seconds_of(tip, upright(len(tip)), 150.0, None, with_jerk(jerk)).sum()
        for jerk in (1e4, 1e5, 1e6, 1e8, 1e12, np.inf)
    ]
    assert (np.diff(seconds) < 0).all()
    assert seconds[-2] == pytest.approx(seconds[-1], rel=1e-3)


def test_a_control_that_stops_at_blocks_takes_each_from_rest_to_rest():
    blocks, length, feed = 30, 2.0, 50.0
    line = straight(blocks * length, blocks), upright(blocks + 1), feed
    stopping = seconds_of(*line, None, with_jerk(np.inf, stops_at_blocks=True))
    assert stopping[1:] == pytest.approx(np.full(blocks, length / feed + feed / LINEAR))
    jerky = seconds_of(*line, None, with_jerk(stops_at_blocks=True))
    assert jerky[1:] == pytest.approx(np.full(blocks, s_curve(length, feed, LINEAR, JERK)))
    machine, moves, linear = with_jerk(np.inf, stops_at_blocks=True), *moves_of(*line)
    assert move_seconds(machine, moves, linear, blends=True).sum() == pytest.approx(
        blocks * length / feed + feed / LINEAR
    )


def test_short_blocks_take_the_time_that_the_control_needs_for_each():
    blocks, length, feed = 200, 0.05, 100.0  # 0.5 ms each at the feed
    machine = with_jerk(np.inf, block_time_ms=4.0)
    seconds = seconds_of(straight(blocks * length, blocks), upright(blocks + 1), feed, None, machine)
    slow = length / 0.004
    assert seconds[1:].sum() == pytest.approx(blocks * 0.004 + slow / LINEAR)
    assert seconds[0] == 0.004


@pytest.mark.parametrize("key", ["block_time_ms", "stops_at_blocks"])
def test_wrong_values_of_the_control_are_named(key):
    with pytest.raises(InputError, match=rf"\[control\] {key}"):
        MachineControl(**{key: -1.0})
    with pytest.raises(InputError, match="max_jerk_mm_per_s3"):
        with_jerk(0.0)
