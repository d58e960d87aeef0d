"""Checks that prove a program from its text alone: what the machine will do, not what the writer meant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..base import Floats
from ..machine import Machine
from . import kinematics
from .control import Control
from .finding import Finding, finding_at
from .poses import angles_of, posed, poses_of
from .reader import Motion, ParsedProgram
from .state import check_state
from .straightness import check_straightness
from .walk import Walk

TIP_TOLERANCE_MM = 0.001
AXIS_TOLERANCE_DEG = 0.001
# Rounding of a word to four decimals, and a little more: how far over a limit its last digit may be.
WORD_ROUNDING = 1e-4
HALF_TURN_DEG = 180.0
# Between two samples of a move neither rotary axis turns more than this.
SAMPLE_TURN_DEG = 1.0
# |side| of a rotary solution under which the pose counts as the place where both meet: about 1e-3 degrees from it.
SIDE_EPSILON = 2e-5


@dataclass(frozen=True)
class RoundTrip:
    """How the program's poses, by forward kinematics, compare with a CL list."""

    findings: list[Finding]
    tip_error_mm: float
    axis_error_deg: float


def check_grammar(program: ParsedProgram) -> list[Finding]:
    """Every line is one the control takes, numbered upwards, between its head and its end."""
    return [Finding("grammar", number, text, message) for number, text, message in program.grammar]


def check_round_trip(
    program: ParsedProgram,
    machine: Machine,
    tip: Floats,
    axis: Floats,
    tip_tolerance_mm: float = TIP_TOLERANCE_MM,
    axis_tolerance_deg: float = AXIS_TOLERANCE_DEG,
    control: Control = Control(),
) -> RoundTrip:
    """Every pose of the CL list (tip (N, 3), axis (N, 3), the program's frame) is met in its order, under M128 or by the
    joints, and blocks between two of them stay on the straight line and the great circle that join them. In the
    machine's pole cone the axis may be off by twice the cone more: the first rotary axis turns there."""
    motion = program.motion()
    poses = poses_of(motion, machine, control)
    in_cone = _in_pole_cone(machine, poses.axis, axis_tolerance_deg)
    at_most = min(2 * machine.kinematics.pole_cone_deg, control.between_deg)
    slack_deg = np.where(in_cone, at_most, 0.0).tolist()
    walk = Walk(tip, axis, tip_tolerance_mm, axis_tolerance_deg, may_rise=not control.tcp)
    findings = []
    rapid = motion.rapid[poses.row].tolist()
    tools = [i for i, block in enumerate(program.blocks) if "T" in block.words]
    calls = np.searchsorted(tools, motion.block[poses.row]).tolist()  # tool calls before each pose
    last_call = 0
    for call, row, at, direction, fast, slack in zip(
        calls, poses.row.tolist(), poses.tip.tolist(), poses.axis.tolist(), rapid, slack_deg
    ):
        if call != last_call:
            walk.leave()
            last_call = call
        message = walk.step(at, direction, fast, slack)
        if message:
            findings.append(finding_at("round trip", program, motion, row, message))
    if walk.next < len(tip):
        message = f"pose {walk.next} of {len(tip)} in the CL list is not met"
        findings.append(Finding("round trip", None, "", message))
    return RoundTrip(findings, walk.tip_error_mm, walk.axis_error_deg)


def _in_pole_cone(machine: Machine, axes: Floats, rounding_deg: float) -> NDArray[np.bool_]:
    """Which of the tool axes (N, 3) stand in the machine's pole cone, where both rotary solutions meet."""
    return np.asarray(
        kinematics.pole_distance_deg(machine, axes) <= machine.kinematics.pole_cone_deg + rounding_deg
    )


def check_limits(program: ParsedProgram, machine: Machine, control: Control = Control()) -> list[Finding]:
    """All five axes stay within their limits, along whole moves: under M128 the linear axes follow the rotary ones."""
    motion = program.motion()
    angles = angles_of(motion, machine)
    findings = []
    for k, rotary in enumerate(machine.rotary_axes):
        limits = (rotary.name, rotary.min_limit_deg, rotary.max_limit_deg, "degrees")
        findings += _limit_findings(program, motion, np.arange(len(angles)), angles[:, k], limits)
    rows, readings = _readings(motion, machine, angles, control)
    for k, linear in enumerate(machine.linear_axes):
        limits = (linear.name, linear.min_limit_mm, linear.max_limit_mm, "mm")
        findings += _limit_findings(program, motion, rows, readings[:, k], limits)
    return findings


def _limit_findings(
    program: ParsedProgram,
    motion: Motion,
    rows: NDArray[np.int64],
    readings: Floats,
    limits: tuple[str, float, float, str],
) -> list[Finding]:
    """One finding for each block (rows: of motion, sorted) that leaves the limits, with its worst reading."""
    name, low, high, unit = limits
    over = np.maximum(low - readings, readings - high)  # NaN, a reading that is not known, compares false
    findings = []
    for row in np.unique(rows[over > WORD_ROUNDING]).tolist():
        first, last = np.searchsorted(rows, (row, row + 1))
        worst = readings[first + np.nanargmax(over[first:last])]
        message = f"{name} goes to {worst:.4f} {unit}, its limits are {low:g} and {high:g}"
        findings.append(finding_at("limits", program, motion, row, message))
    return findings


def _readings(
    motion: Motion, machine: Machine, angles: Floats, control: Control
) -> tuple[NDArray[np.int64], Floats]:
    """Readings of the linear axes in all moves: (S,) row of motion, (S, 3). Joints run evenly: their ends tell it
    all."""
    origin, length = control.setup_of(machine)
    if not control.tcp:
        return np.arange(len(angles)), motion.linear + kinematics.datum_mm(machine, origin, length)
    rows, tip, at = _samples_under_tcp(motion, angles)
    return rows, kinematics.linear_readings(machine, tip, at, origin, length)


def _samples_under_tcp(motion: Motion, angles: Floats) -> tuple[NDArray[np.int64], Floats, Floats]:
    """(S,) row of motion, tip (S, 3) and angles (S, 2) along all moves; moves without M128 have their end only."""
    start_angles = np.vstack((angles[:1], angles[:-1]))
    start_tip = np.vstack((motion.tip[:1], motion.tip[:-1]))
    turn = np.abs(angles - start_angles).max(axis=1, initial=0.0)
    known = motion.tcp & np.isfinite(turn) & np.isfinite(start_tip).all(axis=1)
    count = np.where(known, np.ceil(np.nan_to_num(turn) / SAMPLE_TURN_DEG), 1).astype(np.int64)
    count = np.maximum(count, 1)
    rows = np.repeat(np.arange(len(count)), count)
    step = np.arange(len(rows)) - np.repeat(np.cumsum(count) - count, count) + 1
    back = (1.0 - step / count[rows])[:, None]  # how much of the move is still to go
    blend = np.where(known[rows][:, None], back, 0.0)
    tip = motion.tip[rows] - blend * np.nan_to_num(motion.tip - start_tip)[rows]
    return rows, tip, angles[rows] - blend * np.nan_to_num(angles - start_angles)[rows]


def check_continuity(
    program: ParsedProgram,
    machine: Machine,
    max_rotary_step_deg: float | None = None,
    control: Control = Control(),
) -> list[Finding]:
    """Rotary axes turn evenly: no jump through half a turn in a feed move, nor in a rapid of an axis without limits;
    no step over the limit (None: the machine's) and no change of the rotary solution in a feed move."""
    motion = program.motion()
    angles = angles_of(motion, machine)
    step_limit = (
        machine.kinematics.max_rotary_step_deg if max_rotary_step_deg is None else max_rotary_step_deg
    )
    known = posed(motion, machine, control)
    together = known[1:] & known[:-1]
    cuts = together & ~motion.rapid[1:]
    steps = np.abs(np.diff(angles, axis=0))
    findings = []
    for k, letter in enumerate(machine.rotary_letters):
        # A rapid may turn by half a turn: it is at clearance, where the way round does not matter. An axis with limits
        # rewinds there; one without has no reason to.
        wound = not np.isinf(
            [machine.rotary_axes[k].min_limit_deg, machine.rotary_axes[k].max_limit_deg]
        ).all()
        far = together & (steps[:, k] > HALF_TURN_DEG + WORD_ROUNDING) & (not wound)
        jump = far | (cuts & (steps[:, k] >= HALF_TURN_DEG))
        wide = cuts & ~jump & (steps[:, k] > step_limit + 2 * WORD_ROUNDING)
        for row in np.flatnonzero(jump | wide).tolist():
            limit = HALF_TURN_DEG if jump[row] else step_limit
            message = f"{letter} turns by {steps[row, k]:.4f} degrees in one block, more than {limit:g}"
            findings.append(finding_at("continuity", program, motion, row + 1, message))
    findings += _wide_vectors(program, motion, cuts, step_limit)
    return findings + _solution_changes(program, machine, motion, known, cuts)


def _wide_vectors(
    program: ParsedProgram, motion: Motion, cuts: NDArray[np.bool_], step_limit: float
) -> list[Finding]:
    """Feed moves whose direction, given as a vector, turns by more than a rotary axis may."""
    turn = kinematics.angles_between_deg(motion.axis[1:], motion.axis[:-1])
    return [
        finding_at(
            "continuity", program, motion, row + 1, f"the tool turns by {turn[row]:.4f} degrees in one block"
        )
        for row in np.flatnonzero(cuts & (turn > step_limit)).tolist()
    ]


def _solution_changes(
    program: ParsedProgram,
    machine: Machine,
    motion: Motion,
    known: NDArray[np.bool_],
    cuts: NDArray[np.bool_],
) -> list[Finding]:
    """Feed moves in which the rotary solution is not the one of the feed moves before; where both meet, at the pole and
    at the end of the reach, it is neither, and at the pole it may change."""
    angles = angles_of(motion, machine)
    side = kinematics.solution_side(machine, angles)
    at_pole = _in_pole_cone(machine, kinematics.tool_axes(machine, angles), AXIS_TOLERANCE_DEG)
    poles = np.cumsum(at_pole)  # rows at the pole up to each
    run = np.cumsum(
        np.append(True, ~cuts)
    )  # feed moves without another move between them have the same number
    clear = np.flatnonzero(known & (np.abs(side) > SIDE_EPSILON))
    before, after = clear[:-1], clear[1:]
    through_pole = (poles[after] > poles[before]) | at_pole[before]
    changed = after[(run[before] == run[after]) & (side[before] * side[after] < 0) & ~through_pole]
    message = "the rotary axes change to their other solution in a cut"
    return [finding_at("continuity", program, motion, row, message) for row in changed.tolist()]


@dataclass(frozen=True)
class CheckResult:
    """All checks of a program. The errors are NaN when there was no CL list to compare with."""

    findings: list[Finding]
    tip_error_mm: float = float("nan")
    axis_error_deg: float = float("nan")
    tip_between_mm: float = (
        0.0  # off the line between the ends of a feed move; 0 where the control holds the tip
    )
    axis_between_deg: float = 0.0  # off the great circle

    @property
    def good(self) -> bool:
        """No check has found anything; without a CL list less was checked."""
        return not self.findings


def check_program(
    program: ParsedProgram,
    machine: Machine,
    tip: Floats | None = None,
    axis: Floats | None = None,
    control: Control = Control(),
) -> CheckResult:
    """All checks; against the CL list tip (N, 3), axis (N, 3) of the program's frame where it is given."""
    straight = check_straightness(program, machine, control)
    findings = check_grammar(program) + check_state(program, control)
    findings += check_limits(program, machine, control)
    findings += check_continuity(program, machine, control=control) + straight.findings
    between = (straight.tip_mm, straight.axis_deg)
    if tip is None or axis is None:
        return CheckResult(findings, float("nan"), float("nan"), *between)
    trip = check_round_trip(program, machine, tip, axis, control=control)
    return CheckResult(findings + trip.findings, trip.tip_error_mm, trip.axis_error_deg, *between)
