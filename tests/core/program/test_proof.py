"""The proof program: it stops at every direction, and the machine really points there."""

import re

import numpy as np
import pytest
from machine_samples import directions as unit
from machine_samples import with_rotary

from freecad_mpm.core import machine as machines
from freecad_mpm.core import posts
from freecad_mpm.core.commands import cli
from freecad_mpm.core.control import Control, check_program, dialects, kinematics
from freecad_mpm.core.job import Job, MachineSpec, Part, PostSpec, ToolSpec
from freecad_mpm.core.program import find_shop, proof_file
from freecad_mpm.core.program.proof import directions, proof_program

BOX = (np.array([-60.0, -40.0, 0.0]), np.array([80.0, 60.0, 45.0]))
TOLD = re.compile(r"TILT (\S+) TOWARDS AZIMUTH (\S+) - TOOL POINTS TO (\S+) (\S+) (\S+)")


def job_of(machine, post, tcp=True):
    return Job(
        Part("part.step"),
        ToolSpec(6.7, 6.0),
        machine=MachineSpec(name=machine),
        post=PostSpec(name=post, tcp=tcp),
    )


def text_of(machine, post, tcp=True):
    job = job_of(machine, post, tcp)
    return proof_file(job, find_shop(job), BOX).text


def test_the_directions_are_those_named():
    axes, told = directions()
    turns = np.array([[float(v) for v in TOLD.match(line).groups()] for line in told])
    assert np.abs(unit(turns[:, 0], turns[:, 1]) - axes).max() < 1e-12
    assert np.abs(turns[:, 2:] - axes).max() < 1e-4
    assert len(axes) == 10


@pytest.mark.parametrize("post", posts.names())
@pytest.mark.parametrize("machine", ["dmu80p", "table_ac", "head_cb", "linuxcnc_xyzac"])
def test_at_every_stop_the_tool_points_where_the_comment_says(machine, post):
    """Read back from the text; between the stops it turns over the part with its tip held."""
    parsed = dialects.read(text_of(machine, post), posts.load(post).dialect)
    axes, _ = directions()
    assert check_program(parsed, machines.load(machine)).findings == []
    seen = axes_at_stops(parsed, machines.load(machine))
    assert len(seen) == len(axes)
    assert kinematics.angles_between_deg(seen, axes).max() < 1e-4
    assert not any(block.spindle for block in parsed.blocks)


def axes_at_stops(parsed, machine):
    axes, last = [], None
    for block in parsed.blocks:
        if block.axis:
            last = np.array(block.axis)
        elif block.moves:
            angles = ["ABC".index(letter) for letter in machine.rotary_letters]
            last = kinematics.tool_axes(machine, np.array([[block.position[3 + k] for k in angles]]))[0]
        if 0 in block.m or block.text == "STOP":
            axes.append(last)
    return np.array(axes)


@pytest.mark.parametrize("post", [name for name in posts.names() if posts.load(name).joints])
def test_without_tip_control_it_is_a_program_of_joints(post):
    text = text_of("table_ac", post, tcp=False)
    control = Control(tcp=False, spindle=False)
    parsed = dialects.read(text, posts.load(post).dialect)
    assert check_program(parsed, machines.load("table_ac"), control=control).findings == []
    job = job_of("table_ac", post, tcp=False)
    moves = proof_program(job, find_shop(job), BOX).moves
    assert (
        np.abs(moves.tip[:, 2] - moves.tip[0, 2]).max() < 1e-9
        or moves.tip[:, 2].min() >= moves.tip[0, 2] - 1e-9
    )


def test_a_machine_that_turns_the_other_way_points_elsewhere():
    parsed = dialects.read(text_of("table_ac", "fanuc"), "fanuc")
    seen = axes_at_stops(parsed, with_rotary(machines.load("table_ac"), 1, sense=-1))
    assert kinematics.angles_between_deg(seen, directions()[0]).max() > 15


def test_plan_writes_it_on_request(job_file, tmp_path):
    assert cli.main(["plan", str(job_file), "--out", str(tmp_path / "out"), "--proof"]) == 0
    text = (tmp_path / "out" / "proof.I").read_text()
    assert text.count(" M0 *") == len(directions()[0])
    assert "M5 *" in text and "M3 *" not in text and "M8" not in text
