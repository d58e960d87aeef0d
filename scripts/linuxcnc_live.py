#!/usr/bin/python3
"""Runs a program on LinuxCNC's own controller, simulated and without a window, and compares where the tool went with
the text.

On a machine with LinuxCNC installed, as a user who is not root (docs/posts.md, "On the live controller"):

    scripts/linuxcnc_live.py run FOLDER PROGRAM.ngc
    scripts/linuxcnc_live.py compare FOLDER PROGRAM.ngc

`run` makes a configuration of the tilting table xyzac-trt-kins in FOLDER, as machine file linuxcnc_xyzac has it, runs
the program, and leaves samples.txt: what the five joints are told each millisecond, and the program's line. `compare`
needs this add-on, built."""

import subprocess
import sys
import time
from pathlib import Path

MACHINE, TOOL_LENGTH_MM = "linuxcnc_xyzac", 150.0
LINEAR = {"MAX_VELOCITY": 500, "MAX_ACCELERATION": 5000, "MIN_LIMIT": -5000, "MAX_LIMIT": 5000}
ROTARY = {"MAX_VELOCITY": 120, "MAX_ACCELERATION": 360, "MIN_LIMIT": -36000, "MAX_LIMIT": 36000}
INI = """[EMC]
VERSION = 1.1
[DISPLAY]
DISPLAY = ./ui.py
[RS274NGC]
SUBROUTINE_PATH = .
HAL_PIN_VARS = 1
REMAP = M428 modalgroup=10 ngc=tcp_on
REMAP = M429 modalgroup=10 ngc=tcp_off
PARAMETER_FILE = machine.var
[KINS]
KINEMATICS = xyzac-trt-kins sparm=identityfirst
JOINTS = 5
[HAL]
HALFILE = LIB:basic_sim.tcl -no_use_hal_manualtoolchange
HALFILE = sample.hal
HALCMD = net :kinstype-select <= motion.analog-out-03 => motion.switchkins-type
HALCMD = net :tool-offset motion.tooloffset.z xyzac-trt-kins.tool-offset
HALCMD = setp xyzac-trt-kins.y-offset 10
HALCMD = setp xyzac-trt-kins.z-offset 20
[TRAJ]
COORDINATES = XYZAC
LINEAR_UNITS = mm
ANGULAR_UNITS = deg
MAX_LINEAR_VELOCITY = 500
MAX_LINEAR_ACCELERATION = 5000
[EMCMOT]
EMCMOT = motmod
SERVO_PERIOD = 1000000
[TASK]
TASK = milltask
CYCLE_TIME = 0.010
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.100
TOOL_TABLE = tool.tbl
"""
SAMPLE = (
    "loadrt sampler depth=60000 cfg=fffffs\naddf sampler.0 servo-thread\n"
    + "".join(f"net J{k}:pos-cmd => sampler.0.pin.{k}\n" for k in range(5))
    + "net line motion.program-line => sampler.0.pin.5\n"
)
SWITCH = "o<{0}> sub\nM68 E3 Q{1}\nM66 E0 L0\no<{0}> endsub\nM2\n"
LONGEST_RUN_S = 1800.0
HZ = 1000  # samples a second


def run(folder, program):
    """Configure, and run LinuxCNC until its stand-in for a window (this file again) has seen the program's end."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "machine.ini").write_text(INI + "".join(_axis(*one) for one in enumerate("XYZAC")))
    (folder / "sample.hal").write_text(SAMPLE)
    (folder / "tool.tbl").write_text(f"T1 P1 Z{TOOL_LENGTH_MM} D25.4\n")
    for name, number in (("tcp_on", 1), ("tcp_off", 0)):
        (folder / f"{name}.ngc").write_text(SWITCH.format(name, number))
    window = folder / "ui.py"
    window.write_text(
        f"#!/bin/sh\nexec /usr/bin/python3 {Path(__file__).resolve()} window . {program.resolve()}\n"
    )
    window.chmod(0o755)
    subprocess.run(["linuxcnc", "-r", "machine.ini"], cwd=folder, check=True, timeout=LONGEST_RUN_S)


def _axis(number, letter):
    limits = LINEAR if letter in "XYZ" else ROTARY
    kind = "LINEAR" if letter in "XYZ" else "ANGULAR"
    words = "".join(f"{name} = {value}\n" for name, value in limits.items())
    joint = (
        f"TYPE = {kind}\nHOME = 0\nHOME_SEARCH_VEL = 0\nHOME_SEQUENCE = 0\nFERROR = 100\nMIN_FERROR = 100\n"
    )
    return f"[AXIS_{letter}]\n{words}[JOINT_{number}]\n{joint}{words}"


def window(folder, program):
    """What LinuxCNC starts in place of a window: machine on, home, run, sample."""
    import linuxcnc

    command, state = linuxcnc.command(), linuxcnc.stat()

    def do(action, *arguments):
        action(*arguments)
        command.wait_complete()

    do(command.state, linuxcnc.STATE_ESTOP_RESET)
    do(command.state, linuxcnc.STATE_ON)
    do(command.home, -1)
    time.sleep(1.0)
    do(command.teleop_enable, 1)
    do(command.mode, linuxcnc.MODE_AUTO)
    sampler = subprocess.Popen(["halsampler", "-c", "0", "-t", str(folder / "samples.txt")])
    do(command.program_open, str(program))
    command.auto(linuxcnc.AUTO_RUN, 0)
    time.sleep(1.0)
    while state.poll() or state.interp_state != linuxcnc.INTERP_IDLE or not state.inpos:
        time.sleep(0.1)
    time.sleep(1.0)
    sampler.terminate()


def compare(folder, program):
    """Print how far tip and axis were off the blocks of the program, by the checks' own kinematics."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    import numpy as np

    from freecad_mpm.core import machine as machines
    from freecad_mpm.core.control import dialects, kinematics

    machine = machines.load(MACHINE)
    motion = dialects.read(program.read_text()).motion()
    samples = np.loadtxt(folder / "samples.txt")
    joints, line = samples[:, 1:6], samples[:, 6].astype(int)
    tip = kinematics.tips(machine, joints[:, :3], joints[:, [4, 3]], np.zeros(3), TOOL_LENGTH_MM)
    axis = kinematics.tool_axes(machine, joints[:, [4, 3]])
    ends = kinematics.tool_axes(machine, np.column_stack((motion.angles["C"], motion.angles["A"])))
    worst = {"feed": [0.0, 0.0, 0.0, 0, 0.0], "rapid": [0.0, 0.0, 0.0, 0, 0.0]}
    rows = np.flatnonzero(motion.tcp[1:] & motion.tcp[:-1]) + 1
    for row in rows[np.isfinite(motion.tip[rows - 1]).all(axis=1)].tolist():
        here = line == motion.block[row] + 1
        if not here.any():
            continue
        # The line that a sample is told to belong to may be a sample late: its neighbours count as well.
        off = np.min(
            [
                _off(motion.tip, ends, k, tip[here], axis[here], kinematics)
                for k in (row - 1, row, row + 1)
                if 0 < k < len(motion.tip) and np.isfinite(motion.tip[k - 1 : k + 1]).all()
            ],
            axis=0,
        )
        found = worst["rapid" if motion.rapid[row] else "feed"]
        swing = np.ptp(joints[here, 4])
        found[:] = [
            *np.maximum(found[:3], (*off.max(axis=0), swing)),
            found[3] + 1,
            found[4] + here.sum() / HZ,
        ]
    for kind, (tip_mm, axis_deg, swing_deg, count, seconds) in worst.items():
        print(
            f"{kind}: {count:.0f} blocks in {seconds:.1f} s, tip off <= {1000 * tip_mm:.3f} µm, "
            f"axis off <= {axis_deg:.4f} deg, largest turn of C {swing_deg:.3f} deg"
        )
    print(f"{len(samples) / HZ:.1f} s with what comes before and after")


def _off(tips, ends, row, tip, axis, kinematics):
    """(S, 2) distance of the samples' tips from the line of a block, and angle of their axes from its great circle
    there."""
    import numpy as np

    start, way = tips[row - 1], tips[row] - tips[row - 1]
    length = way @ way
    along = np.clip((tip - start) @ way / length, 0, 1) if length > 0 else np.zeros(len(tip))
    meant = np.vstack(
        [kinematics.great_circle(ends[row - 1 : row], ends[row : row + 1], s) for s in along.tolist()]
    )
    angle = kinematics.angles_between_deg(axis, meant) if length > 0 else np.zeros(len(tip))
    return np.column_stack((np.linalg.norm(tip - start - along[:, None] * way, axis=1), angle))


if __name__ == "__main__":
    {"run": run, "window": window, "compare": compare}[sys.argv[1]](Path(sys.argv[2]), Path(sys.argv[3]))
