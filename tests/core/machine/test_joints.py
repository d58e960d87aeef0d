"""Joint values of whole paths, and the numpy kinematics of the checks against the native ones."""

from dataclasses import replace

import numpy as np
import pytest
from machine_samples import directions, dmu80p, two_passes, with_kinematics, with_rotary

from freecad_mpm import _core
from freecad_mpm.core.control import kinematics
from freecad_mpm.core.job.budget import axis_tolerance_deg
from freecad_mpm.core.machine import joint_path

ORIGIN, LENGTH = (30.0, -40.0, 120.0), 137.0
SETUP = _core.PartSetup(part_origin_mm=ORIGIN, tool_length_mm=LENGTH)


def crooked_machine():
    """Nothing in line: measured axis directions, offsets, a reversed table, shifted zeros."""
    machine = with_rotary(
        dmu80p(),
        0,
        rotation_vector=(0.01, -0.02, 1.0),
        joint_origin_mm=(3.0, -2.0, 5.0),
        sense=-1,
        zero_offset_deg=12.0,
    )
    return with_rotary(machine, 1, rotation_vector=(0.02, 1.0, 0.98), zero_offset_deg=-3.0)


def table_table_machine():
    return with_rotary(
        dmu80p(), 1, role="table_rotary", joint_origin_mm=(1.0, 2.0, -60.0), min_limit_deg=-180.0
    )


def head_head_machine():
    return with_rotary(dmu80p(), 0, role="head_rotary", joint_origin_mm=(4.0, 5.0, 170.0))


MACHINES = [dmu80p, crooked_machine, table_table_machine, head_head_machine]


@pytest.mark.parametrize("make", MACHINES)
def test_both_solutions_of_random_poses_go_round(make):
    machine, random = make(), np.random.default_rng(4)
    tip = random.uniform(-100, 100, (500, 3))
    axis = directions(random.uniform(3, 80, 500), random.uniform(-180, 180, 500))
    chain = machine.chain()
    solutions = chain.inverse(tip, axis, setup=SETUP)
    assert solutions["reachable"].all()
    for k in range(2):
        back_tip, back_axis = chain.forward(
            solutions["linear_mm"][:, k], solutions["rotary_deg"][:, k], setup=SETUP
        )
        assert np.abs(back_tip - tip).max() < 1e-9
        assert np.abs(back_axis - axis).max() < 1e-12


@pytest.mark.parametrize("make", MACHINES)
def test_numpy_kinematics_of_the_checks_agree_with_the_native(make):
    machine, random = make(), np.random.default_rng(5)
    angles = random.uniform(-720, 720, (300, 2))
    linear = random.uniform(-300, 300, (300, 3))
    tip, axis = machine.chain().forward(linear, angles, setup=SETUP)
    assert np.abs(kinematics.tool_axes(machine, angles) - axis).max() < 1e-12
    assert (
        np.abs(kinematics.linear_readings(machine, tip, angles, np.array(ORIGIN), LENGTH) - linear).max()
        < 1e-9
    )


def test_solution_side_tells_the_two_solutions_apart():
    machine, random = crooked_machine(), np.random.default_rng(6)
    axis = directions(random.uniform(3, 80, 300), random.uniform(-180, 180, 300))
    both = machine.chain().inverse(np.zeros((300, 3)), axis)["rotary_deg"]
    sides = [kinematics.solution_side(machine, both[:, k]) for k in range(2)]
    assert (np.sign(sides[0]) == np.sign(sides[0][0])).all()
    assert (np.sign(sides[1]) == -np.sign(sides[0][0])).all()


def test_given_poses_are_kept_in_order_and_met():
    kind, tip, axis, feed = two_passes()
    path = joint_path(dmu80p(), kind, tip, axis, feed, axis_tolerance_deg=0.02)
    last = np.append(np.flatnonzero(np.diff(path.move)), len(path) - 1)
    assert len(path) > len(kind)
    assert path.move[last].tolist() == list(range(len(kind)))
    assert (path.tip[last] == tip).all()
    assert (
        kinematics.angles_between_deg(kinematics.tool_axes(dmu80p(), path.rotary_deg), path.axis).max() < 1e-9
    )
    assert path.troubles() == []


def test_table_unwinds_over_the_seam_and_steps_stay_small():
    kind, tip, axis, feed = two_passes()
    path = joint_path(dmu80p(), kind, tip, axis, feed, axis_tolerance_deg=0.02)
    cuts = path.kind[1:] == "cut"
    assert np.abs(np.diff(path.rotary_deg, axis=0))[cuts].max() <= dmu80p().kinematics.max_rotary_step_deg
    assert np.ptp(path.rotary_deg[:, 0]) > 360


@pytest.mark.parametrize("rise", [-10.0, 0.0, 10.0])
def test_rapids_turn_with_the_tip_held_at_their_higher_end(rise):
    tip = np.array([[0.0, 0, 50], [30.0, 0, 50 + rise]])
    axis = directions([10.0, 20.0], [0.0, 90.0])
    path = joint_path(dmu80p(), np.array(["rapid"] * 2), tip, axis, np.zeros(2), axis_tolerance_deg=0.02)
    assert len(path) == 3
    turning = np.flatnonzero(np.any(np.diff(path.rotary_deg, axis=0) != 0, axis=1))
    travelling = np.flatnonzero(np.any(np.diff(path.tip, axis=0) != 0, axis=1))
    assert (turning.tolist(), travelling.tolist()) == (([1], [0]) if rise > 0 else ([0], [1]))


def test_rapids_that_only_travel_or_only_turn_stay_one():
    tip = np.array([[0.0, 0, 50], [30.0, 0, 50], [30.0, 0, 50]])
    axis = directions([10.0, 10.0, 20.0], [0.0, 0.0, 90.0])
    path = joint_path(dmu80p(), np.array(["rapid"] * 3), tip, axis, np.zeros(3), axis_tolerance_deg=0.02)
    assert len(path) == 3


def test_solution_changes_only_in_rapids_that_turn_on_the_spot():
    machine = with_rotary(dmu80p(), 1, min_limit_deg=-180.0, max_limit_deg=40.0)
    kind, tip, axis, feed = two_passes()
    axis = axis.copy()
    axis[len(kind) // 2 :] = directions(
        45.0, 30.0
    )  # the second pass needs a tilt over the limit: the other solution
    path = joint_path(machine, kind, tip, axis, feed, axis_tolerance_deg=0.02)
    assert path.troubles() == []
    side = np.sign(kinematics.solution_side(machine, path.rotary_deg))
    changes = np.flatnonzero(np.diff(side)) + 1
    assert len(changes) == 1 and path.kind[changes[0]] == "rapid"
    assert (path.tip[changes[0]] == path.tip[changes[0] - 1]).all()


def test_cut_through_the_pole_keeps_the_direction_within_the_cone():
    tilt = np.linspace(-6, 6, 25)
    tip = np.column_stack((np.linspace(0, 50, 25), np.zeros(25), np.zeros(25)))
    axis = directions(np.abs(tilt), np.where(tilt < 0, 20.0, 200.0))
    kind = np.array(["rapid"] + ["cut"] * 24)
    machine = with_kinematics(dmu80p(), pole_cone_deg=0.0004)
    path = joint_path(machine, kind, tip, axis, np.full(25, 1000.0), axis_tolerance_deg=0.02)
    assert path.at_pole.any()
    off = kinematics.angles_between_deg(kinematics.tool_axes(machine, path.rotary_deg), path.axis)
    assert off.max() <= 2 * 0.0004
    assert path.troubles() == []


def test_troubles_name_the_first_move():
    kind, tip, axis, feed = two_passes()
    axis = axis.copy()
    axis[5] = (1.0, 0.0, -0.5) / np.linalg.norm((1.0, 0.0, -0.5))
    machine = with_rotary(dmu80p(), 1, max_limit_deg=15.0)
    troubles = joint_path(machine, kind, tip, axis, feed, axis_tolerance_deg=0.02).troubles()
    assert any("cannot give the tool's direction" in line and "move 5" in line for line in troubles)
    assert any("a rotary axis leaves its limits" in line for line in troubles)
    short = replace(
        dmu80p(),
        linear_axes=(replace(dmu80p().linear_axes[0], max_limit_mm=-200.0), *dmu80p().linear_axes[1:]),
    )
    assert "a linear axis" in joint_path(short, *two_passes(), axis_tolerance_deg=0.02).troubles()[0]


def test_bad_arguments_are_named():
    machine, (kind, tip, axis, feed) = dmu80p(), two_passes()
    nowhere = tip.copy()
    nowhere[3] = np.nan
    with pytest.raises(ValueError, match=r"tip\["):
        joint_path(machine, kind, nowhere, axis, feed, axis_tolerance_deg=0.02)
    with pytest.raises(ValueError, match="axis_tolerance"):
        joint_path(machine, kind, tip, axis, feed, axis_tolerance_deg=0.0)
    with pytest.raises(ValueError, match=r"axis\[0\]"):
        machine.chain().inverse(tip[:1], np.zeros((1, 3)))
    with pytest.raises(ValueError, match="role"):
        _core.RotaryAxis(name="C", role="table", rotation_vector=(0, 0, 1))


def test_axis_tolerance_of_a_cutter():
    assert axis_tolerance_deg(0.01, 12.7) == pytest.approx(np.degrees(0.01 / 12.7))
