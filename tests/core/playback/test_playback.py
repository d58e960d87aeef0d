"""Playback: the machine's bodies where the path says, closed forms of tables and heads, places by time and way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from machine_samples import AXIS_TOLERANCE_DEG, two_passes

from freecad_mpm.core import machine as machines
from freecad_mpm.core.base import TOOLS
from freecad_mpm.core.job import tool
from freecad_mpm.core.machine import joint_path
from freecad_mpm.core.playback import playback, sketch
from freecad_mpm.core.playback.bodies import body_matrices, inverse, seen_from_part

LENGTH_MM, ORIGIN_MM = 160.0, (12.0, -7.0, 55.0)
UP = np.array([0.0, 0.0, 1.0])


def machine_named(name):
    """With a part origin and a tool length that hide no error."""
    machine = machines.load(name)
    return replace(machine, setup=replace(machine.setup, part_origin_mm=ORIGIN_MM, tool_length_mm=LENGTH_MM))


def playback_of(machine):
    kind, tip, axis, feed = two_passes()
    blocks = joint_path(machine, kind, tip, axis, feed, axis_tolerance_deg=AXIS_TOLERANCE_DEG)
    moves = np.flatnonzero((kind == "cut") | (kind == "plunge"))
    names = np.array([f"status {move}" for move in moves])
    return playback.make_playback(machine, blocks, playback.Visited(moves, names, 0.001 * moves))


@pytest.fixture(scope="module")
def played():
    return playback_of(machine_named("dmu80p"))


@pytest.mark.parametrize("name", machines.names())
def test_the_tool_stands_where_the_path_says_on_every_machine(name):
    """The native inverse gave the readings; the placements are made apart from it."""
    machine = machine_named(name)
    played = playback_of(machine)
    assert "unreachable" not in set(played.blocks.status)
    for row in range(0, len(played.blocks), 7):
        bodies = seen_from_part(
            body_matrices(machine, played.blocks.rotary_deg[row], played.blocks.linear_mm[row])
        )
        assert bodies["tool"][:3, 3] == pytest.approx(played.blocks.tip[row], abs=1e-9)
        assert bodies["tool"][:3, 2] == pytest.approx(played.blocks.axis[row], abs=1e-9)
        assert bodies["part"] == pytest.approx(np.eye(4), abs=1e-12)


def test_a_table_turns_against_its_reading_and_a_head_with_it():
    machine = machine_named("head_b_table_c")  # C carries the part, B the tool; both senses ISO
    bodies = body_matrices(machine, [90.0, 30.0], ORIGIN_MM)
    # The tool moves from x to y relative to the part, thus the part from y to x.
    assert bodies["part"][:3, :3] @ [0, 1, 0] == pytest.approx([1, 0, 0], abs=1e-12)
    assert bodies["part"] == pytest.approx(bodies["C"])
    assert bodies["tool"][:3, 2] == pytest.approx([0.5, 0, np.sqrt(0.75)], abs=1e-12)
    assert bodies["spindle"] == pytest.approx(bodies["B"])
    assert bodies["ram"] == pytest.approx(np.eye(4))


def test_the_outer_table_carries_the_inner_one():
    machine = machine_named("table_ac")
    origin = np.array(machine.rotary_axes[1].joint_origin_mm) - ORIGIN_MM
    bodies = body_matrices(machine, [40.0, -90.0], (0.0, 0.0, 0.0))
    quarter = np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # the table A at -90 turns by +90 about x
    assert bodies["A"][:3, :3] == pytest.approx(quarter, abs=1e-12)
    assert bodies["A"][:3, :3] @ origin + bodies["A"][:3, 3] == pytest.approx(origin)
    alone = body_matrices(machine, [40.0, 0.0], (0.0, 0.0, 0.0))["C"]
    assert bodies["C"] == pytest.approx(bodies["A"] @ alone)


def test_with_the_part_at_rest_all_bodies_keep_their_places_to_each_other(played):
    moment = played.moment(30.4)
    free, fixed = (played.body_matrices(moment, part_fixed) for part_fixed in (False, True))
    for name in free:
        assert fixed[name] == pytest.approx(inverse(free["part"]) @ free[name], abs=1e-9)


def test_a_place_between_two_blocks_runs_evenly(played):
    blocks = played.blocks
    moment = played.moment(20.25)
    assert moment.tip == pytest.approx(0.75 * blocks.tip[20] + 0.25 * blocks.tip[21])
    assert moment.rotary_deg == pytest.approx(0.75 * blocks.rotary_deg[20] + 0.25 * blocks.rotary_deg[21])
    assert moment.move == blocks.move[21]
    assert played.moment(20.0).move == blocks.move[20]
    # Evenly turning axes leave the straight line of directions by no more than the path's tolerance.
    chord = 0.75 * blocks.axis[20] + 0.25 * blocks.axis[21]
    angle = np.degrees(np.arccos(np.clip(moment.axis @ chord / np.linalg.norm(chord), -1, 1)))
    assert angle < 2 * AXIS_TOLERANCE_DEG


def test_ends_and_beyond(played):
    for place, row in ((-3.0, 0), (0.0, 0), (played.last, -1), (played.last + 5, -1)):
        assert played.moment(place).tip == pytest.approx(played.blocks.tip[row])


def test_feed_moves_take_their_length_by_their_feed(played):
    blocks = played.blocks
    cut = next(i for i in range(5, len(blocks)) if blocks.kind[i] == "cut")
    length = np.linalg.norm(blocks.tip[cut] - blocks.tip[cut - 1])
    took = played.seconds_at(cut) - played.seconds_at(cut - 1)
    assert took >= 60 * length / blocks.feed_mm_per_min[cut] - 1e-9
    middle = played.at_seconds(played.seconds_at(cut - 1) + took / 2)
    assert middle == pytest.approx(cut - 0.5)
    assert played.at_seconds(-1) == 0 and played.at_seconds(1e9) == played.last


def test_by_way_of_the_tip(played):
    total = np.linalg.norm(np.diff(played.blocks.tip, axis=0), axis=1).sum()
    assert played.at_way(0) == 0
    assert played.way_mm[-1] == pytest.approx(total)
    tips = [played.moment(played.at_way(way)).tip for way in np.arange(0.0, 40.0, 1.0)]
    steps = np.linalg.norm(np.diff(tips, axis=0), axis=1)
    assert steps.max() <= 1 + 1e-9  # chords are no longer than the way


def test_advancing_by_the_machines_time_and_evenly(played):
    total = played.seconds[-1]
    assert played.seconds_at(played.advance(12.5, 0.5)) == pytest.approx(played.seconds_at(12.5) + 0.5)
    mean = played.way_mm[-1] / total
    place, ways = 0.0, [0.0]
    for _ in range(20):
        place = played.advance(place, 0.05, evenly=True)
        ways.append(played.way_at(place))
    assert np.diff(ways) == pytest.approx(0.05 * mean)
    assert played.advance(0.0, total, evenly=True) == pytest.approx(played.last)
    assert played.advance(5.0, 2 * total) == played.last


def test_positions_are_reached_in_their_order(played):
    kind, tip, axis, _ = two_passes()
    for number in range(len(played.visited.move)):
        moment = played.moment(played.at_position(number))
        assert moment.move == played.visited.move[number]
        assert played.at_move(moment.move) == played.at_position(number)
        assert moment.tip == pytest.approx(tip[moment.move])
        assert moment.axis == pytest.approx(axis[moment.move], abs=1e-9)


def test_steps_to_the_neighbours(played):
    assert played.position_before(0.0) == -1
    assert played.position_after(0.0) == 0
    at = played.at_position(3)
    assert played.position_before(at) == 3 and played.position_after(at) == 4
    assert played.position_before(at - 0.5) == 2 and played.position_after(at - 0.5) == 3
    assert played.position_after(played.last) == len(played.visited.move) - 1


@pytest.mark.parametrize("name", machines.names())
def test_the_sketch_has_every_body_and_the_table_lies_under_the_part(name):
    machine = machine_named(name)
    low, high = np.array([-20.0, -30.0, -10.0]), np.array([100.0, 90.0, 40.0])
    bodies = sketch.sketch(machine, (low, high), tool.load(TOOLS / "thesis.toml"))
    assert set(bodies) == {*machine.rotary_letters, "spindle", "ram"}
    first = machine.rotary_axes[0]
    if first.role == "table_rotary":
        assert bodies[first.name].points[:, 2].max() <= low[2] + 1e-9
    placed = body_matrices(machine, [0.0, 0.0], ORIGIN_MM)
    assert set(bodies) <= set(placed)
