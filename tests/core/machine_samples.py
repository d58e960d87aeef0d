"""Paths and machines that the tests of machine, posts and checks share."""

from dataclasses import replace

import numpy as np

from freecad_mpm.core import machine as machines
from freecad_mpm.core.machine import joint_path
from freecad_mpm.core.posts import Program, ProgramTool

AXIS_TOLERANCE_DEG, TIP_TOLERANCE_MM = 0.02, 0.0025


def directions(tilt_deg, azimuth_deg):
    """Unit vectors (N, 3) by their angle from z and their azimuth from x."""
    tilt, azimuth = np.radians(np.broadcast_arrays(tilt_deg, azimuth_deg))
    return np.stack((np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), np.cos(tilt)), axis=-1)


def two_passes():
    """kind, tip, axis, feed of two wavy passes with a link over them; the azimuth goes round more than once."""
    count = 40
    s = np.linspace(0.0, 1.0, count)
    rows = []
    for number in range(2):
        tip = np.column_stack((80 * s, np.full(count, 20.0 * number), 5 * np.sin(4 * s)))
        axis = directions(14 + 8 * np.sin(5 * s + number), 400 * s + 130 * number)
        rows += [("rapid", [*tip[0][:2], 40.0], axis[0], 0.0), ("plunge", tip[0], axis[0], 300.0)]
        rows += [("cut", tip[i], axis[i], 1500.0) for i in range(1, count)]
        rows += [("retract", tip[-1] + 5 * axis[-1], axis[-1], 500.0)]
        rows += [("rapid", [tip[-1][0], tip[-1][1], 40.0], axis[-1], 0.0)]
    kind, tip, axis, feed = zip(*rows)
    return np.array(kind), np.array(tip, float), np.array(axis, float), np.array(feed)


def dmu80p():
    return machines.load("dmu80p")


def program_of(kind, tip, axis, feed, machine=None, tcp=True, **changes):
    """tcp: False: a program of joint positions, its tip within TIP_TOLERANCE_MM of its lines."""
    machine = machine or dmu80p()
    tip_tolerance = None if tcp else TIP_TOLERANCE_MM
    moves = joint_path(
        machine, kind, tip, axis, feed, axis_tolerance_deg=AXIS_TOLERANCE_DEG, tip_tolerance_mm=tip_tolerance
    )
    setup = machine.setup
    datum = np.array(setup.part_origin_mm) + [0.0, 0.0, setup.tool_length_mm]
    blank = (np.array([-5.0, -5.0, -25.0]), np.array([85.0, 59.0, 25.0]))
    program = Program("MPM01", machine, ProgramTool(1, 12.7, 6.0), 8000, moves, blank=blank)
    program = program if tcp else replace(program, axes_mm=moves.linear_mm - datum)
    return replace(program, **changes)


def with_kinematics(machine, **changes):
    return replace(machine, kinematics=replace(machine.kinematics, **changes))


def with_rotary(machine, index, **changes):
    axes = list(machine.rotary_axes)
    axes[index] = replace(axes[index], **changes)
    return replace(machine, rotary_axes=tuple(axes))
