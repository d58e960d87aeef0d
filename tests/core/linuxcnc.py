"""LinuxCNC for tests, without LinuxCNC running: its interpreter and its kinematics modules.

Debian's linuxcnc-uspace is used where it is installed, or unpacked: into the folder that MPM_LINUXCNC names, or into
build/linuxcnc, where scripts/linuxcnc (called by ./dev test) puts it."""

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
CHECKOUT = HERE.parents[1]


def _root():
    named = os.environ.get("MPM_LINUXCNC")
    places = [Path(named)] if named else [Path("/"), CHECKOUT / "build/linuxcnc"]
    return next((place for place in places if (place / "usr/bin/rs274").exists()), places[-1]).resolve()


ROOT = _root()
RS274 = ROOT / "usr/bin/rs274"
MODULES = ROOT / "usr/lib/linuxcnc/modules"
LIBRARIES = f"{ROOT / 'usr/lib'}:{ROOT / 'usr/lib/x86_64-linux-gnu'}"
THERE = RS274.exists()
MISSING = f"no linuxcnc-uspace: neither installed nor in {ROOT} (scripts/linuxcnc says why)"

TOOL_LENGTH_MM = 150.0
MM_PER_INCH = 25.4
SPINDLE_MM = 1000.0  # a second point of the tool's axis, so far along the spindle
POSE = "XYZABCUVW"
SWITCH = "o<{0}> sub\n({0})\nM68 E3 Q{1}\nM66 E0 L0\no<{0}> endsub\nM2\n"
INI = """[RS274NGC]
SUBROUTINE_PATH = .
REMAP = M428 modalgroup=10 ngc=tcp_on
REMAP = M429 modalgroup=10 ngc=tcp_off
[TRAJ]
LINEAR_UNITS = mm
COORDINATES = XYZABC
"""


@dataclass(frozen=True)
class Module:
    """One of its kinematics modules and how our machine of that kind is told to it."""

    name: str
    joints: str  # their letters, in the module's order
    kind: int  # number of its five-axis kinematics among those it can switch between
    pins: dict[str, float]
    along: int  # the joint that moves along the spindle, and its sign
    sign: int = 1


MODULE_OF = {
    "linuxcnc_xyzac": Module(
        "xyzac-trt-kins", "XYZAC", 0, {"y-offset": 10, "z-offset": 20, "tool-offset": TOOL_LENGTH_MM}, 2
    ),
    "linuxcnc_xyzbc": Module(
        "xyzbc-trt-kins", "XYZBC", 0, {"x-offset": 10, "z-offset": 20, "tool-offset": TOOL_LENGTH_MM}, 2
    ),
    "linuxcnc_xyzab": Module(
        "xyzab_tdr_kins", "XYZAB", 1, {"z-offset": 20, "tool-offset-z": TOOL_LENGTH_MM}, 2
    ),
    "linuxcnc_5axis": Module("5axiskins", "XYZBCW", 0, {"pivot-length": 100 + TOOL_LENGTH_MM}, 5, -1),
}


def environment(folder):
    """A home of its own: two interpreters at a time would share files there."""
    packages = ROOT / "usr/lib/python3/dist-packages"
    paths = {"LD_LIBRARY_PATH": LIBRARIES, "PYTHONPATH": str(packages), "PATH": os.environ["PATH"]}
    return {"HOME": str(folder), "INI_FILE_NAME": "machine.ini", **paths}


def prepare(folder, text):
    (folder / "machine.ini").write_text(INI)
    (folder / "tcp_on.ngc").write_text(SWITCH.format("tcp_on", 1))
    (folder / "tcp_off.ngc").write_text(SWITCH.format("tcp_off", 0))
    (folder / "program.ngc").write_text(text)


def run_rs274(folder, text):
    """Exit status, canonical calls (four decimals) and complaints of the stand-alone interpreter."""
    prepare(folder, text)
    # the stand-alone interpreter reads its tool table in inches
    (folder / "tool.tbl").write_text(f"T1 P1 Z{TOOL_LENGTH_MM / MM_PER_INCH:.9f} D1.0\n")
    command = [RS274, "-g", "-i", "machine.ini", "-t", "tool.tbl", "-v", "rs.var", "program.ngc", "calls.txt"]
    done = _run(command, folder, check=False)
    return done.returncode, (folder / "calls.txt").read_text(), done.stderr


def canonical_moves(folder, text):
    """All its moves at full precision: (K, 6) X Y Z (mm, tool length off) A B C (degrees), (K,) feed in 1/min or mm/min,
    (K,) traverse, (K,) after M428."""
    prepare(folder, text)
    (folder / "tool.tbl").write_text(f"T1 P1 Z{TOOL_LENGTH_MM} D1.0\n")
    _run([sys.executable, HERE / "linuxcnc_canon.py", "program.ngc", "tool.tbl", "moves.npy"], folder)
    rows = np.load(folder / "moves.npy")
    return rows[:, :6], rows[:, 6] == 1, rows[:, 7] == 1


def _run(command, folder, check=True):
    return subprocess.run(
        command,
        cwd=folder,
        env=environment(folder),
        capture_output=True,
        text=True,
        timeout=600,  # only what will never end takes so long, on a loaded machine too
        check=check,
    )


def build_driver(folder):
    program = folder / "linuxcnc_kinematics"
    source = HERE / "linuxcnc_kinematics.c"
    subprocess.run(["gcc", "-O1", "-rdynamic", source, "-o", program, "-ldl", "-lm"], check=True)
    return program


def run_module(driver, machine, direction, numbers):
    """(N, 9) of the shipped module for (N, up to 9): joints in its order, or poses in the order of POSE."""
    module = MODULE_OF[machine.name]
    lines = np.zeros((len(numbers), len(POSE)))
    lines[:, : numbers.shape[1]] = numbers
    # What HAL calls a module need not be its file's name, but begins its pins.
    pins = [f"{module.name}.{pin}={value}" for pin, value in module.pins.items()]
    command = [driver, MODULES / f"{module.name}.so", module.joints, direction, str(module.kind), *pins]
    text = "\n".join(" ".join(f"{v:.17g}" for v in line) for line in lines.tolist())
    done = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    return np.array(done.stdout.split(), dtype=float).reshape(-1, len(POSE))


def joints_of(machine, linear, rotary):
    """Our readings (N, 3), (N, 2) in the module's order."""
    columns = dict(zip("XYZ", linear.T)) | dict(zip(machine.rotary_letters, rotary.T))
    none = np.zeros(len(linear))
    return np.column_stack([columns.get(letter, none) for letter in MODULE_OF[machine.name].joints])


def pose_of(xyz, abc):
    """Poses as LinuxCNC hands them to its kinematics: tips with the tool's length on top."""
    return np.hstack((xyz + [0.0, 0.0, TOOL_LENGTH_MM], abc))


def tip_and_axis(driver, machine, joints):
    """By the module's forward kinematics. Its pose holds the tool's length in Z; the axis is what a move along the
    spindle does."""
    module = MODULE_OF[machine.name]
    further = joints.copy()
    further[:, module.along] += module.sign * SPINDLE_MM
    pose, beyond = (run_module(driver, machine, "forward", rows)[:, :3] for rows in (joints, further))
    return pose - [0.0, 0.0, TOOL_LENGTH_MM], (beyond - pose) / SPINDLE_MM


def moves_under_tcp(calls):
    """(K, 6) ends of the canonical moves between M428 and M429 of rs274's calls, and whether each is a traverse."""
    on = calls.index("SET_AUX_OUTPUT_VALUE(3,1.000000)")
    off = calls.index("SET_AUX_OUTPUT_VALUE(3,0.000000)", on)
    found = re.findall(r"STRAIGHT_(TRAVERSE|FEED)\(([^)]*)\)", calls[on:off])
    return np.array([[float(v) for v in ends.split(",")] for _, ends in found]), [
        kind == "TRAVERSE" for kind, _ in found
    ]
