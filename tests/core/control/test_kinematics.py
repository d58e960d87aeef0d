"""Every shipped machine: closed forms of its arrangement, both solutions, and the round trip of random poses."""

import numpy as np
import pytest
from machine_samples import directions, with_rotary

from freecad_mpm import _core
from freecad_mpm.core import machine as machines
from freecad_mpm.core.control import kinematics

TIP_TOLERANCE_MM = AXIS_TOLERANCE = 1e-9
ORIGIN, LENGTH = (12.0, -7.0, 55.0), 160.0
SETUP = _core.PartSetup(part_origin_mm=ORIGIN, tool_length_mm=LENGTH)
COUNT = 500

SINE_45 = np.sqrt(0.5)


def sc(deg):
    return np.sin(np.radians(deg)), np.cos(np.radians(deg))


def axis_ac(c, a):
    """Table C on (or head C before) a tilt A about X, ISO senses."""
    (sin_c, cos_c), (sin_a, cos_a) = sc(c), sc(a)
    return np.column_stack((sin_a * sin_c, -sin_a * cos_c, cos_a))


def axis_bc(c, b):
    (sin_c, cos_c), (sin_b, cos_b) = sc(c), sc(b)
    return np.column_stack((sin_b * cos_c, sin_b * sin_c, cos_b))


def axis_nutating(c, b):
    """u = Rot((0, 1, 1)/sqrt 2, B) z, then turned by C about z."""
    (sin_c, cos_c), (sin_b, cos_b) = sc(c), sc(b)
    u, v, w = SINE_45 * sin_b, (1 - cos_b) / 2, (1 + cos_b) / 2
    return np.column_stack((cos_c * u - sin_c * v, sin_c * u + cos_c * v, w))


def axis_ab(a, b):
    """Table A about X that carries a table B about Y."""
    (sin_a, cos_a), (sin_b, cos_b) = sc(a), sc(b)
    return np.column_stack((sin_b, -sin_a * cos_b, cos_a * cos_b))


CLOSED_FORM = {
    "dmu80p": axis_nutating,
    "dmu80p_ac": axis_ac,
    "table_ac": axis_ac,
    "table_bc": axis_bc,
    "nutating_table_bc": axis_nutating,
    "nutating_head_bc": axis_nutating,
    "head_b_table_c": axis_bc,
    "head_ca": axis_ac,
    "head_cb": axis_bc,
    "linuxcnc_5axis": lambda c, b: axis_bc(c, -b),
    "linuxcnc_xyzab": axis_ab,
    "linuxcnc_xyzac": lambda c, a: axis_ac(-c, -a),
    "linuxcnc_xyzbc": lambda c, b: axis_bc(-c, -b),
}


def random_readings(random):
    return np.column_stack((random.uniform(-400, 400, COUNT), random.uniform(-175, 175, COUNT)))


def random_poses(random):
    """Tips, and axes of the upper half sphere, which every arrangement reaches."""
    return random.uniform(-200, 200, (COUNT, 3)), directions(
        np.degrees(np.arccos(random.uniform(0.001, 1, COUNT))), random.uniform(0, 360, COUNT)
    )


def test_every_shipped_machine_has_a_closed_form_here():
    assert sorted(CLOSED_FORM) == machines.names()


@pytest.mark.parametrize("name", machines.names())
def test_the_tool_axis_is_that_of_the_arrangement(name):
    rotary = random_readings(np.random.default_rng(1))
    _, axis = machines.load(name).chain().forward(np.zeros((COUNT, 3)), rotary, setup=SETUP)
    assert np.abs(axis - CLOSED_FORM[name](*rotary.T)).max() < AXIS_TOLERANCE


@pytest.mark.parametrize("name", machines.names())
def test_both_solutions_bring_tip_and_axis_there(name):
    assert_round_trip(machines.load(name))


@pytest.mark.parametrize("name", machines.names())
def test_a_measured_machine_is_inverted_as_exactly(name):
    """Axes out of square by up to half a degree and out of place by some tenths: still closed, no iteration."""
    machine, random = machines.load(name), np.random.default_rng(2)
    for k in (0, 1):
        given = machine.rotary_axes[k]
        machine = with_rotary(
            machine,
            k,
            rotation_vector=tuple(np.array(given.rotation_vector) + random.uniform(-0.008, 0.008, 3)),
            joint_origin_mm=tuple(np.array(given.joint_origin_mm) + random.uniform(-0.3, 0.3, 3)),
            zero_offset_deg=random.uniform(-1, 1),
        )
    assert_round_trip(machine)


def assert_round_trip(machine):
    tip, axis = random_poses(np.random.default_rng(3))
    chain = machine.chain()
    solved = chain.inverse(tip, axis, setup=SETUP)
    reached = solved["reachable"]
    assert np.count_nonzero(reached) > 0.9 * COUNT
    for branch in (0, 1):
        linear, rotary = solved["linear_mm"][:, branch], solved["rotary_deg"][:, branch]
        tip_back, axis_back = chain.forward(linear, rotary, setup=SETUP)
        assert np.abs(tip_back - tip).max() < TIP_TOLERANCE_MM
        assert np.abs(axis_back - axis)[reached].max() < AXIS_TOLERANCE
        # the checks' own kinematics, written apart
        assert np.abs(kinematics.tool_axes(machine, rotary) - axis)[reached].max() < AXIS_TOLERANCE
        own = kinematics.linear_readings(machine, tip, rotary, np.array(ORIGIN), LENGTH)
        assert np.abs(own - linear).max() < TIP_TOLERANCE_MM
    apart = np.abs(np.diff(np.radians(solved["rotary_deg"]), axis=1)).max(axis=2)
    assert np.count_nonzero(apart > 1e-3) > 0.9 * COUNT  # the two differ


@pytest.mark.parametrize("name", machines.names())
def test_a_turned_sense_is_noticed(name):
    machine = machines.load(name)
    rotary = random_readings(np.random.default_rng(4))
    turned = with_rotary(machine, 0, sense=-machine.rotary_axes[0].sense)
    assert (
        np.abs(kinematics.tool_axes(turned, rotary) - CLOSED_FORM[name](*rotary.T)).max(axis=1).mean() > 0.1
    )


def test_45_degree_axes_lag_as_published():
    """Tilt 10 degrees: B = 14.16, C lags by 5.02 degrees; tilt 45: B = 65.53, C lags by 24.47."""
    axis = directions(np.array([10.0, 45.0]), np.zeros(2))
    solved = machines.load("nutating_table_bc").chain().inverse(np.zeros((2, 3)), axis, setup=SETUP)
    positive = solved["rotary_deg"][np.arange(2), np.argmax(solved["rotary_deg"][:, :, 1], axis=1)]
    assert np.abs(positive - [[-5.02, 14.16], [-24.47, 65.53]]).max() < 0.01
