"""LinuxCNC as an independent reader and kinematician: its interpreter runs our program, its modules agree with us.

It needs Debian's linuxcnc-uspace, which ./dev does not install (110 packages with what it needs). It is used where it is
installed, or unpacked with libboost-python1.74.0 (dpkg -x) into the folder that MPM_LINUXCNC names; elsewhere this is
skipped."""

import os
import re
import subprocess
from pathlib import Path

import numpy as np
import pytest
from machine_samples import program_of, two_passes, with_rotary

from freecad_mpm.core import dialects, machines, posts

ROOT = Path(
    os.environ.get("MPM_LINUXCNC")
    or next((p for p in ("/", "build/linuxcnc") if Path(p, "usr/bin/rs274").exists()), "/")
).resolve()
RS274 = ROOT / "usr/bin/rs274"
MODULES = ROOT / "usr/lib/linuxcnc/modules"
LIBRARIES = f"{ROOT / 'usr/lib'}:{ROOT / 'usr/lib/x86_64-linux-gnu'}"

pytestmark = pytest.mark.skipif(
    not RS274.exists(), reason="linuxcnc-uspace is neither installed nor in MPM_LINUXCNC"
)

TOOL_LENGTH_MM = 120.0
TIP_MM = AXIS_DEG = 1e-6
SPINDLE_MM = 1000.0  # a second point of the tool's axis, so far along the spindle
COUNT = 500
TRUNNIONS = {"linuxcnc_xyzac": ("xyzac-trt-kins", "y"), "linuxcnc_xyzbc": ("xyzbc-trt-kins", "x")}
SWITCH = "o<{0}> sub\nM68 E3 Q{1}\nM66 E0 L0\no<{0}> endsub\nM2\n"
INI = """[RS274NGC]
SUBROUTINE_PATH = .
REMAP = M428 modalgroup=10 ngc=tcp_on
REMAP = M429 modalgroup=10 ngc=tcp_off
[TRAJ]
LINEAR_UNITS = mm
COORDINATES = XYZABC
"""


def run_rs274(folder, text):
    """Exit status, canonical calls and complaints of LinuxCNC's interpreter, with a home of its own."""
    (folder / "machine.ini").write_text(INI)
    (folder / "tcp_on.ngc").write_text(SWITCH.format("tcp_on", 1))
    (folder / "tcp_off.ngc").write_text(SWITCH.format("tcp_off", 0))
    # the stand-alone interpreter reads its tool table in inches
    (folder / "tool.tbl").write_text(f"T1 P1 Z{TOOL_LENGTH_MM / 25.4:.9f} D1.0\n")
    (folder / "program.ngc").write_text(text)
    command = [RS274, "-g", "-i", "machine.ini", "-t", "tool.tbl", "-v", "rs.var", "program.ngc", "calls.txt"]
    done = subprocess.run(
        command,
        cwd=folder,
        env={"HOME": str(folder), "LD_LIBRARY_PATH": LIBRARIES, "PATH": os.environ["PATH"]},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    return done.returncode, (folder / "calls.txt").read_text(), done.stderr


def program_text(name):
    kind, tip, axis, feed = two_passes()
    return posts.load("linuxcnc").write(program_of(kind, tip, axis, feed, machines.load(name)))


def moves_under_tcp(calls):
    """(K, 6) ends of the canonical moves between M428 and M429, and whether each is a traverse."""
    on = calls.index("SET_AUX_OUTPUT_VALUE(3,1.000000)")
    off = calls.index("SET_AUX_OUTPUT_VALUE(3,0.000000)", on)
    found = re.findall(r"STRAIGHT_(TRAVERSE|FEED)\(([^)]*)\)", calls[on:off])
    return np.array([[float(v) for v in ends.split(",")] for _, ends in found]), [
        kind == "TRAVERSE" for kind, _ in found
    ]


@pytest.mark.parametrize("name", TRUNNIONS)
def test_the_interpreter_moves_where_our_reader_says(tmp_path, name):
    text = program_text(name)
    status, calls, complaints = run_rs274(tmp_path, text)
    assert status == 0, complaints
    theirs, traverses = moves_under_tcp(calls)
    ours = dialects.read(text).motion()
    known = ours.tcp & np.isfinite(ours.tip).all(axis=1)
    angles = np.column_stack([np.nan_to_num(ours.angles[letter]) for letter in "ABC"])
    skipped = len(theirs) - np.count_nonzero(known)
    assert skipped == 1  # X and Y alone, where our reader does not know Z
    assert np.abs(theirs[skipped:] - np.hstack((ours.tip, angles))[known]).max() < 1e-9
    assert traverses[skipped:] == ours.rapid[known].tolist()
    assert len(theirs) > 150


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
    status, _, complaints = run_rs274(tmp_path, broken)
    assert status == 1 and told in complaints


@pytest.fixture(scope="module")
def driver(tmp_path_factory):
    program = tmp_path_factory.mktemp("kinematics") / "linuxcnc_kinematics"
    source = Path(__file__).with_name("linuxcnc_kinematics.c")
    subprocess.run(["gcc", "-O1", "-rdynamic", source, "-o", program, "-ldl", "-lm"], check=True)
    return program


def run_module(driver, machine, direction, numbers):
    """(N, 9) of the shipped module for (N, up to 9), with the offsets of our machine file."""
    module, beside = TRUNNIONS[machine.name]
    tilt = machine.rotary_axes[1]
    offset = {"x": tilt.joint_origin_mm[0], "y": tilt.joint_origin_mm[1], "z": tilt.joint_origin_mm[2]}
    pins = {f"{beside}-offset": offset[beside], "z-offset": offset["z"], "tool-offset": TOOL_LENGTH_MM}
    lines = np.zeros((len(numbers), 9))
    lines[:, : numbers.shape[1]] = numbers
    done = subprocess.run(
        [driver, MODULES / f"{module}.so", f"XYZ{tilt.name}C", direction]
        + [f"{module}.{pin}={value}" for pin, value in pins.items()],
        input="\n".join(" ".join(f"{v:.17g}" for v in line) for line in lines),
        capture_output=True,
        text=True,
        check=True,
    )
    return np.array([[float(v) for v in line.split()] for line in done.stdout.splitlines()])


def random_joints():
    random = np.random.default_rng(7)
    return np.hstack((random.uniform(-200, 200, (COUNT, 3)), random.uniform(-170, 170, (COUNT, 2))))


def their_pose(driver, machine, joints):
    """Tip and axis. Their pose holds the tool's length in Z; the axis is what a move along the spindle does."""
    pose = run_module(driver, machine, "forward", joints)
    further = run_module(driver, machine, "forward", joints + [0, 0, SPINDLE_MM, 0, 0])
    return pose[:, :3] - [0, 0, TOOL_LENGTH_MM], (further - pose)[:, :3] / SPINDLE_MM


def angle_deg(a, b):
    return np.degrees(np.linalg.norm(np.cross(a, b), axis=1))


@pytest.mark.parametrize("name", TRUNNIONS)
def test_forward_kinematics_agree(driver, name):
    machine, joints = machines.load(name), random_joints()
    tip, axis = machine.chain().forward(joints[:, :3], joints[:, [4, 3]], tool_length_mm=TOOL_LENGTH_MM)
    their_tip, their_axis = their_pose(driver, machine, joints)
    assert np.abs(tip - their_tip).max() < TIP_MM
    assert np.einsum("ij,ij->i", axis, their_axis).min() > 0
    assert angle_deg(axis, their_axis).max() < AXIS_DEG


@pytest.mark.parametrize("name", TRUNNIONS)
def test_a_turned_sense_is_seen_in_the_axis(driver, name):
    machine, joints = machines.load(name), random_joints()
    turned = with_rotary(machine, 0, sense=1).chain()
    _, axis = turned.forward(joints[:, :3], joints[:, [4, 3]], tool_length_mm=TOOL_LENGTH_MM)
    assert np.median(angle_deg(axis, their_pose(driver, machine, joints)[1])) > 10


@pytest.mark.parametrize("name", TRUNNIONS)
def test_a_posted_program_takes_their_machine_where_the_path_goes(driver, name):
    """Text -> our reader -> their inverse -> their forward: tip and axis of the path, but for the words' rounding."""
    machine = machines.load(name)
    motion = dialects.read(program_text(name)).motion()
    cuts = motion.tcp & ~motion.rapid
    pose = np.zeros((np.count_nonzero(cuts), 6))
    pose[:, :3] = motion.tip[cuts] + [0, 0, TOOL_LENGTH_MM]
    pose[:, 3:] = np.column_stack([np.nan_to_num(motion.angles[letter][cuts]) for letter in "ABC"])
    joints = run_module(driver, machine, "inverse", pose)[:, :5]
    tip, axis = their_pose(driver, machine, joints)
    assert np.abs(tip - motion.tip[cuts]).max() < TIP_MM
    _, wanted_tip, wanted_axis, _ = two_passes()
    for index in range(len(wanted_tip)):
        near = np.flatnonzero(np.abs(tip - wanted_tip[index]).max(axis=1) < 1e-4)
        if two_passes()[0][index] == "cut":
            assert len(near) and angle_deg(axis[near], wanted_axis[[index]]).min() < 1e-4
