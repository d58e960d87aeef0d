"""Cuts through the pole and past it, where the first rotary axis has to turn far in little way: what the emitted text
does, looked at densely, on every shipped machine."""

import numpy as np
import pytest
from machine_samples import AXIS_TOLERANCE_DEG, program_of, with_kinematics, with_rotary
from part_samples import TOOL

from freecad_mpm.core import job
from freecad_mpm.core import machine as machines
from freecad_mpm.core import planning, posts
from freecad_mpm.core.control import Control, check_program, dialects, kinematics
from freecad_mpm.core.control.poses import angles_of
from freecad_mpm.core.job import control_deviation_deg

# 0: through the pole itself; the others: within the cone of 0.0004 degrees, just outside of it, and farther
DISTANCES_DEG = [0.0, 1e-7, 2e-4, 3.9e-4, 4.1e-4, 1e-3, 0.02, 0.5]
SAMPLES = np.linspace(0.0, 1.0, 21)
# of a word with four decimals, on both axes
ROUNDING_DEG = 1e-4
FEED_MM_PER_MIN = 1000.0


def unit(vector):
    return np.array(vector) / np.linalg.norm(vector)


def past_the_pole(machine, distance_deg):
    """kind, tip, axis, feed of a pass of 41 poses whose axis goes from 6 degrees on one side of the pole to 6 on the
    other, a quarter of a step beside its middle pose."""
    pole = unit(machine.rotary_axes[0].rotation_vector)
    # a level first axis has no whole turn: from one side to the other, over the upper half of its turn
    along = unit(np.cross(pole, (0.3, 1.0, 0.2))) if abs(pole[2]) > 0.5 else np.array([0.0, 1.0, 0.0])
    across = np.cross(pole, along)
    s = np.radians(np.linspace(-6.0, 6.0, 41) + 0.075)[:, None]
    d = np.radians(distance_deg)
    axis = np.cos(d) * (np.cos(s) * pole + np.sin(s) * along) + np.sin(d) * across
    tip = np.column_stack((np.linspace(-20, 20, 41), np.zeros(41), np.zeros(41)))
    kind = np.array(["rapid"] + ["cut"] * 40)
    return kind, tip, axis, np.full(41, FEED_MM_PER_MIN)


def way_of_text(text, post, machine):
    """Tip (K, 3) and axis (K, 3) all along the feed moves of a text, its rotary axes running evenly in each block."""
    motion = dialects.read(text, posts.load(post).dialect).motion()
    angles = angles_of(motion, machine)
    ends = np.flatnonzero(~motion.rapid & motion.tcp & np.append(False, motion.tcp[:-1]))
    tips, axes = [], []
    for s in SAMPLES:
        tips.append(motion.tip[ends - 1] + s * (motion.tip[ends] - motion.tip[ends - 1]))
        axes.append(kinematics.tool_axes(machine, angles[ends - 1] + s * (angles[ends] - angles[ends - 1])))
    return np.concatenate(tips), np.concatenate(axes)


def off_the_way_deg(tip, axis, given_tip, given_axis, along=0):
    """By how much the axis (K, 3) is off the great circles between the given poses, where its tip is; along: the
    coordinate in which the given tips rise."""
    count = np.arange(len(given_tip))
    place = np.clip(np.interp(tip[:, along], given_tip[:, along], count), 0, len(given_tip) - 1)
    before = np.minimum(place.astype(int), len(given_tip) - 2)
    part = place - before
    a, b = given_axis[before], given_axis[before + 1]
    angle = np.radians(kinematics.angles_between_deg(a, b))
    weights = np.sin([(1 - part) * angle, part * angle]) / np.sin(angle)
    return kinematics.angles_between_deg(axis, weights[0][:, None] * a + weights[1][:, None] * b)


def checked(name, distance_deg, machine=None, post="linuxcnc"):
    """The program past the pole, what all checks say, and how far the text leaves the way (degrees)."""
    machine = machine or machines.load(name)
    given = past_the_pole(machine, distance_deg)
    program = program_of(*given, machine)
    text = posts.load(post).write(program)
    control = Control(between_deg=AXIS_TOLERANCE_DEG + ROUNDING_DEG)
    read = dialects.read(text, posts.load(post).dialect)
    result = check_program(read, machine, given[1], given[2], control)
    tip, axis = way_of_text(text, post, machine)
    return program, result, off_the_way_deg(tip, axis, given[1], given[2])


@pytest.mark.parametrize("distance_deg", DISTANCES_DEG)
@pytest.mark.parametrize("name", machines.names())
def test_the_tool_keeps_its_way_past_the_pole(name, distance_deg):
    program, result, off_deg = checked(name, distance_deg)
    steps = np.abs(np.diff(program.moves.rotary_deg, axis=0))[program.moves.kind[1:] == "cut"]
    assert program.moves.troubles() == [] and result.findings == []
    assert off_deg.max() <= AXIS_TOLERANCE_DEG + ROUNDING_DEG
    assert steps.max() <= machines.load(name).kinematics.max_rotary_step_deg * (1 + 1e-9)


def test_the_cut_goes_on_through_zero_where_the_tilt_may_change_its_sign():
    """Trunnions whose preference leaves both solutions open: no turn of C; else half a turn of it on the spot."""
    turns = {name: np.ptp(checked(name, 0.0)[0].moves.rotary_deg[:, 0]) for name in machines.names()}
    through = {name for name, turn in turns.items() if turn < 1e-6}
    open_to_both = {
        name for name in machines.names() if machines.load(name).kinematics.solution_preference == "shortest"
    }
    assert through == open_to_both
    assert all(180.0 - 1e-6 < turn < 190.0 for name, turn in turns.items() if name not in open_to_both)


def test_a_machine_out_of_square_needs_a_cone_as_large():
    """Its tool cannot stand along the first axis: 0.003 degrees, 0.016 mm in 300 mm."""
    off = np.radians(0.003)
    crooked = with_rotary(machines.load("head_b_table_c"), 0, rotation_vector=(0.0, np.sin(off), np.cos(off)))
    wide = with_kinematics(crooked, pole_cone_deg=0.0035)
    program, result, off_deg = checked("", 0.0, wide)
    assert program.moves.troubles() == [] and result.findings == []
    assert 0.002 < off_deg.max() <= AXIS_TOLERANCE_DEG + ROUNDING_DEG
    assert "cannot give the tool's direction" in checked("", 0.0, crooked)[0].moves.troubles()[0]


def test_the_checks_see_an_axis_that_leaves_its_way_at_the_pole():
    """The same text, said to be of a machine with a smaller cone, or turned a little."""
    machine = with_kinematics(machines.load("dmu80p"), pole_cone_deg=0.004)
    given = past_the_pole(machine, 0.0)
    program = program_of(*given, machine)
    read = dialects.read(posts.load("dmu80p").write(program))
    assert check_program(read, machine, given[1], given[2]).findings == []
    small = with_kinematics(machine, pole_cone_deg=0.0004)
    assert {one.check for one in check_program(read, small, given[1], given[2]).findings} == {"round trip"}
    turned = given[2] @ np.array(
        [[1, 0, 0], [0, np.cos(2e-4), -np.sin(2e-4)], [0, np.sin(2e-4), np.cos(2e-4)]]
    )
    assert check_program(read, machine, given[1], turned).findings != []


PART_JOB = """
[part]
file = "{part}"
{tool}[footprint]
direction_deg = 90.0
side_step_mm = 75.0
forward_step_mm = 2.0
[machine]
name = "{machine}"
[post]
name = "linuxcnc"
"""


@pytest.mark.parametrize("machine", ["dmu80p", "linuxcnc_xyzac"])
def test_on_a_part_the_axis_keeps_what_the_certificate_allows(machine, thesis_part, tmp_path):
    """The convex face's middle pass goes over its top, with the tool through the pole."""
    path = tmp_path / "job.toml"
    path.write_text(PART_JOB.format(tool=TOOL, part=thesis_part("convex"), machine=machine))
    plan = planning.plan(job.load(path))
    assert plan.report.verdict.good, plan.report.verdict.line
    assert plan.report.program.report.nearest_to_pole_deg < 1e-6
    middle = plan.path.pass_index == 1
    cuts = middle & (plan.path.kind == "cut")
    cuts[np.flatnonzero(cuts)[0] - 1] = True  # where the first of them starts
    given = plan.path.tip[cuts], plan.path.axis[cuts]
    tip, axis = way_of_text(plan.program.text, "linuxcnc", machines.load(machine))
    y = np.clip(tip[:, 1], given[0][0, 1], given[0][-1, 1])
    on_line = np.column_stack([np.interp(y, given[0][:, 1], given[0][:, k]) for k in range(3)])
    here = np.linalg.norm(tip - on_line, axis=1) < 1e-3
    assert here.sum() > len(SAMPLES) * cuts.sum()
    off_deg = off_the_way_deg(tip[here], axis[here], *given, along=1)
    assert off_deg.max() <= control_deviation_deg(plan.job) + ROUNDING_DEG
