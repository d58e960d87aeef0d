"""LinuxCNC as an independent reader and kinematician: its interpreter runs our program, its modules agree with us.

The whole chain on many blocks: MPM_LINUXCNC_BLOCKS=100000 ./dev test tests/core/posts/test_linuxcnc.py"""

import os
import re
from dataclasses import replace
from functools import cache

import linuxcnc
import numpy as np
import pytest
from linuxcnc import MODULE_OF, TOOL_LENGTH_MM
from machine_samples import directions, program_of, two_passes, with_rotary

from freecad_mpm import _core
from freecad_mpm.core import machine as machines
from freecad_mpm.core import posts
from freecad_mpm.core.control import dialects
from freecad_mpm.core.posts import PostOptions

pytestmark = pytest.mark.skipif(not linuxcnc.THERE, reason=linuxcnc.MISSING)

TIP_MM = AXIS_DEG = 1e-6
JOINTS = 500
BLOCKS = int(os.environ.get("MPM_LINUXCNC_BLOCKS", 10_000))
FINE = PostOptions(decimals=9)


def text_of(program):
    return posts.load("linuxcnc").write(program)


def program_text(name):
    return text_of(program_of(*two_passes(), machines.load(name)))


@pytest.mark.parametrize("name", MODULE_OF)
def test_the_interpreter_moves_where_our_reader_says(tmp_path, name):
    text = program_text(name)
    status, calls, complaints = linuxcnc.run_rs274(tmp_path, text)
    assert status == 0, complaints
    theirs, traverses = linuxcnc.moves_under_tcp(calls)
    ours = dialects.read(text).motion()
    known = ours.tcp & np.isfinite(ours.tip).all(axis=1)
    angles = np.column_stack([np.nan_to_num(ours.angles[letter]) for letter in "ABC"])
    skipped = len(theirs) - np.count_nonzero(known)
    assert skipped == 1  # X and Y alone, where our reader does not know Z
    assert np.abs(theirs[skipped:] - np.hstack((ours.tip, angles))[known]).max() < 1e-9
    assert traverses[skipped:] == ours.rapid[known].tolist()
    assert len(theirs) > 80


@pytest.mark.parametrize(
    "pattern, replacement, told",
    [
        (r"(G1 .*) F.*", r"\1", "F word missing with inverse time"),
        (r"^G1 ", "G43.4 ", "Unknown g code"),
        (r"^M428", "M128", "Unknown m code"),
    ],
)
def test_the_interpreter_refuses_what_it_cannot_take(tmp_path, pattern, replacement, told):
    broken = re.sub(pattern, replacement, program_text("linuxcnc_xyzac"), count=1, flags=re.M)
    status, _, complaints = linuxcnc.run_rs274(tmp_path, broken)
    assert status == 1 and told in complaints


@pytest.mark.parametrize("tcp", [True, False])
def test_the_interpreter_takes_all_options(tmp_path, tcp):
    options = PostOptions(path_tolerance_mm=0.02, coolant="mist", decimals=6, comments=False)
    program = replace(program_of(*two_passes(), machines.load("linuxcnc_xyzac"), tcp=tcp), options=options)
    status, _, complaints = linuxcnc.run_rs274(tmp_path, text_of(program))
    assert status == 0, complaints


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    return linuxcnc.build_driver(tmp_path_factory.mktemp("kinematics"))


def random_joints(machine):
    random = np.random.default_rng(7)
    linear, rotary = random.uniform(-200, 200, (JOINTS, 3)), random.uniform(-170, 170, (JOINTS, 2))
    return linear, rotary, linuxcnc.joints_of(machine, linear, rotary)


def angle_deg(a, b):
    return np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)))


@pytest.mark.parametrize("name", MODULE_OF)
def test_forward_kinematics_agree(driver, name):
    machine = machines.load(name)
    linear, rotary, joints = random_joints(machine)
    tip, axis = machine.chain().forward(linear, rotary, setup=_core.PartSetup(tool_length_mm=TOOL_LENGTH_MM))
    their_tip, their_axis = linuxcnc.tip_and_axis(driver, machine, joints)
    assert np.abs(tip - their_tip).max() < TIP_MM
    assert angle_deg(axis, their_axis).max() < AXIS_DEG


@pytest.mark.parametrize("name", MODULE_OF)
def test_inverse_kinematics_agree(driver, name):
    machine = machines.load(name)
    linear, rotary, joints = random_joints(machine)
    tip, _ = machine.chain().forward(linear, rotary, setup=_core.PartSetup(tool_length_mm=TOOL_LENGTH_MM))
    angles = dict(zip(machine.rotary_letters, rotary.T))
    abc = np.column_stack([angles.get(letter, np.zeros(JOINTS)) for letter in "ABC"])
    theirs = linuxcnc.run_module(driver, machine, "inverse", linuxcnc.pose_of(tip, abc))
    assert np.abs(theirs[:, : joints.shape[1]] - joints).max() < TIP_MM


@pytest.mark.parametrize("index", [0, 1])
@pytest.mark.parametrize("name", MODULE_OF)
def test_a_turned_sense_is_seen_in_the_axis(driver, name, index):
    machine = machines.load(name)
    linear, rotary, joints = random_joints(machine)
    turned = with_rotary(machine, index, sense=-machine.rotary_axes[index].sense).chain()
    _, axis = turned.forward(linear, rotary, setup=_core.PartSetup(tool_length_mm=TOOL_LENGTH_MM))
    assert np.median(angle_deg(axis, linuxcnc.tip_and_axis(driver, machine, joints)[1])) > 10


@cache
def long_path():
    """kind, tip, axis, feed of one long wavy cut, its tilt from 4 to 24 degrees; the azimuth goes round and back."""
    s = np.linspace(0.0, 1.0, BLOCKS)
    tip = np.column_stack((80 * np.cos(40 * s), 60 * np.sin(37 * s), 10 * np.sin(90 * s)))
    axis = directions(14 + 10 * np.sin(31 * s), 150 * np.sin(60 * s))
    kind = np.where(np.arange(BLOCKS) == 0, "rapid", "cut")
    return kind, tip, axis, np.full(BLOCKS, 1500.0)


def long_program(machine, tcp=True):
    return replace(program_of(*long_path(), machine, tcp=tcp), options=FINE)


def at_their_joints(driver, machine, program, folder, tcp):
    """Text -> their interpreter -> their joints: by their inverse, or as programmed. Without the opening and the
    closing."""
    moves, _, under_tcp = linuxcnc.canonical_moves(folder, text_of(program))
    if tcp:
        poses = moves[under_tcp][-len(program.moves) :]
        joints = linuxcnc.run_module(driver, machine, "inverse", linuxcnc.pose_of(poses[:, :3], poses[:, 3:]))
        return joints[:, : len(MODULE_OF[machine.name].joints)]
    words = moves[-len(program.moves) - 2 : -2]  # Z up and the rotary axes to zero come last
    linear = words[:, :3] + machine.setup.part_origin_mm + [0.0, 0.0, TOOL_LENGTH_MM]
    return linuxcnc.joints_of(machine, linear, words[:, [3 + "ABC".index(k) for k in machine.rotary_letters]])


@pytest.mark.parametrize("name", MODULE_OF)
def test_the_whole_chain_under_tcp(driver, tmp_path, name):
    """Path -> text -> their interpreter -> their inverse -> their forward: the path's tip and axis in every block."""
    machine = machines.load(name)
    program = long_program(machine)
    joints = at_their_joints(driver, machine, program, tmp_path, tcp=True)
    tip, axis = linuxcnc.tip_and_axis(driver, machine, joints)
    assert len(tip) >= BLOCKS
    assert np.abs(tip - program.moves.tip).max() < TIP_MM
    assert angle_deg(axis, program.moves.axis).max() < AXIS_DEG


@pytest.mark.parametrize("name", MODULE_OF)
def test_the_whole_chain_of_joint_positions(driver, tmp_path, name):
    """Path -> text -> their interpreter -> their forward."""
    machine = machines.load(name)
    program = long_program(machine, tcp=False)
    joints = at_their_joints(driver, machine, program, tmp_path, tcp=False)
    tip, axis = linuxcnc.tip_and_axis(driver, machine, joints)
    assert len(tip) >= BLOCKS
    assert np.abs(tip - machine.setup.part_origin_mm - program.moves.tip).max() < TIP_MM
    assert angle_deg(axis, program.moves.axis).max() < AXIS_DEG


@pytest.mark.parametrize("name", MODULE_OF)
def test_a_program_for_a_turned_axis_takes_their_tool_astray(driver, tmp_path, name):
    """Under TCP the tip is still right: only the axis tells."""
    machine = machines.load(name)
    turned = with_rotary(machine, 0, sense=-machine.rotary_axes[0].sense)
    program = replace(program_of(*two_passes(), turned), options=FINE)
    joints = at_their_joints(driver, machine, program, tmp_path, tcp=True)
    tip, axis = linuxcnc.tip_and_axis(driver, machine, joints)
    assert np.abs(tip - program.moves.tip).max() < TIP_MM
    assert angle_deg(axis, program.moves.axis).max() > 5
