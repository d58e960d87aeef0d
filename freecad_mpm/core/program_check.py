"""Checks that prove a program from its text alone: what the machine will do, not what the writer meant."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import kinematics
from .cl_walk import Walk
from .machines import Machine
from .program_reader import AXES, Block, Motion, ParsedProgram

Floats = NDArray[np.float64]

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
class Finding:
    """One thing that is wrong: which check found it, where, and what."""

    check: str
    block: int | None
    text: str
    message: str

    def __str__(self) -> str:
        return ": ".join(filter(None, (self.check, self.text, self.message)))


@dataclass(frozen=True)
class RoundTrip:
    """How the program's poses, by forward kinematics, compare with a CL list."""

    findings: list[Finding]
    tip_error_mm: float
    axis_error_deg: float


def check_grammar(program: ParsedProgram) -> list[Finding]:
    """Every line is one the control takes, numbered upwards, between its head and its end."""
    return [Finding("grammar", number, text, message) for number, text, message in program.grammar]


def check_state(program: ParsedProgram) -> list[Finding]:
    """The machine is in the right state for every block: spindle, feed, tool-centre-point control, absolute words."""
    findings = [
        Finding("state", block.number, block.text, message)
        for before, block in zip([None, *program.blocks], program.blocks)
        for message in _state_faults(before, block)
    ]
    if program.blocks and program.blocks[-1].tcp and 129 not in program.blocks[-1].m:
        findings.append(
            Finding("state", program.blocks[-1].number, "", "M128 is on at the end: M129 is missing")
        )
    return findings


def _state_faults(before: Block | None, block: Block) -> list[str]:
    faults = []
    if "T" in block.words and block.tcp:
        faults.append("a tool call while M128 is on")
    if block.machine_datum and block.tcp:
        faults.append("M91 or M92 while M128 is on")
    if not block.moves:
        return faults
    if block.absolute is not True:
        faults.append("a move that is not absolute: G90 must be on")
    if not block.compensation_off:
        faults.append("a move before G40: radius compensation may be on")
    if block.rapid is None:
        faults.append("a move without G00 or G01")
    turns = any(letter in block.words for letter in "ABC") or _new_vector(before, block)
    travels = any(letter in block.words for letter in "XYZ")
    if block.rapid is False:
        faults += _feed_faults(block, turns)
    elif (
        turns
        and travels
        and before is not None
        and (_new_vector(before, block) or _changes(before, block, "ABC"))
        and _changes(before, block, "XYZ")
    ):
        faults.append("a rapid that turns and travels at once: its way is not straight")
    return faults


def _new_vector(before: Block | None, block: Block) -> bool:
    # The first vector of a program stands over the first pose, where the tip is held.
    return block.axis is not None and before is not None and before.axis not in (None, block.axis)


def _feed_faults(block: Block, turns: bool) -> list[str]:
    faults = []
    if not block.spindle:
        faults.append("a feed move with the spindle off")
    if not block.feed > 0:
        faults.append("a feed move before any F")
    if turns and not block.tcp:
        faults.append("rotary axes in a feed move without M128")
    return faults


def _changes(before: Block, block: Block, letters: str) -> bool:
    return any(before.position[AXES.index(k)] != block.position[AXES.index(k)] for k in letters)


def check_round_trip(
    program: ParsedProgram,
    machine: Machine,
    tip: Floats,
    axis: Floats,
    tip_tolerance_mm: float = TIP_TOLERANCE_MM,
    axis_tolerance_deg: float = AXIS_TOLERANCE_DEG,
) -> RoundTrip:
    """Every pose of the CL list (tip (N, 3), axis (N, 3), the program's frame) is met in its order under M128, and
    blocks between two of them stay on the straight line and the great circle that join them."""
    motion = program.motion()
    under_tcp = np.flatnonzero(motion.tcp)
    by_angles = kinematics.tool_axes(machine, _angles(motion, machine)[under_tcp])
    at_axis = np.where(np.isnan(motion.axis[under_tcp]), by_angles, motion.axis[under_tcp])
    walk = Walk(tip, axis, tip_tolerance_mm, axis_tolerance_deg)
    findings = []
    poses = zip(under_tcp.tolist(), motion.tip[under_tcp].tolist(), at_axis.tolist(), motion.rapid[under_tcp])
    for row, at, direction, rapid in poses:
        message = walk.step(at, direction, bool(rapid))
        if message:
            findings.append(_finding("round trip", program, motion, row, message))
    if walk.next < len(tip):
        message = f"pose {walk.next} of {len(tip)} in the CL list is not met"
        findings.append(Finding("round trip", None, "", message))
    return RoundTrip(findings, walk.tip_error_mm, walk.axis_error_deg)


def check_limits(
    program: ParsedProgram, machine: Machine, part_origin_mm: tuple[float, ...], tool_length_mm: float
) -> list[Finding]:
    """All five axes stay within their limits, along whole moves: under M128 the linear axes follow the rotary ones."""
    motion = program.motion()
    angles = _angles(motion, machine)
    findings = []
    for k, rotary in enumerate(machine.rotary_axes):
        limits = (rotary.name, rotary.min_limit_deg, rotary.max_limit_deg, "degrees")
        findings += _limit_findings(program, motion, np.arange(len(angles)), angles[:, k], limits)
    rows, readings = _sampled_readings(motion, machine, angles, part_origin_mm, tool_length_mm)
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
        findings.append(_finding("limits", program, motion, row, message))
    return findings


def _sampled_readings(
    motion: Motion, machine: Machine, angles: Floats, part_origin_mm: tuple[float, ...], tool_length_mm: float
) -> tuple[NDArray[np.int64], Floats]:
    """Linear readings along all moves: (S,) row of motion, (S, 3). Moves without M128 are sampled at their end."""
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
    at = angles[rows] - blend * np.nan_to_num(angles - start_angles)[rows]
    return rows, kinematics.linear_readings(machine, tip, at, np.array(part_origin_mm), tool_length_mm)


def check_continuity(
    program: ParsedProgram, machine: Machine, max_rotary_step_deg: float | None = None
) -> list[Finding]:
    """Rotary axes turn evenly: no jump through half a turn under M128, no step over the limit (None: the machine's) and
    no change of the rotary solution in a feed move."""
    motion = program.motion()
    angles = _angles(motion, machine)
    step_limit = (
        machine.kinematics.max_rotary_step_deg if max_rotary_step_deg is None else max_rotary_step_deg
    )
    under_tcp = motion.tcp[1:] & motion.tcp[:-1]
    cuts = under_tcp & ~motion.rapid[1:]
    steps = np.abs(np.diff(angles, axis=0))
    findings = []
    for k, letter in enumerate(machine.rotary_letters):
        # A rapid may turn by half a turn: it is at clearance, where the way round does not matter.
        jump = (under_tcp & (steps[:, k] > HALF_TURN_DEG + WORD_ROUNDING)) | (
            cuts & (steps[:, k] >= HALF_TURN_DEG)
        )
        wide = cuts & ~jump & (steps[:, k] > step_limit + 2 * WORD_ROUNDING)
        for row in np.flatnonzero(jump | wide).tolist():
            limit = HALF_TURN_DEG if jump[row] else step_limit
            message = f"{letter} turns by {steps[row, k]:.4f} degrees in one block, more than {limit:g}"
            findings.append(_finding("continuity", program, motion, row + 1, message))
    findings += _wide_vectors(program, motion, cuts, step_limit)
    return findings + _solution_changes(program, machine, motion, angles, cuts)


def _wide_vectors(
    program: ParsedProgram, motion: Motion, cuts: NDArray[np.bool_], step_limit: float
) -> list[Finding]:
    """Feed moves whose direction, given as a vector, turns by more than a rotary axis may."""
    turn = kinematics.angles_between_deg(motion.axis[1:], motion.axis[:-1])
    return [
        _finding(
            "continuity", program, motion, row + 1, f"the tool turns by {turn[row]:.4f} degrees in one block"
        )
        for row in np.flatnonzero(cuts & (turn > step_limit)).tolist()
    ]


def _solution_changes(
    program: ParsedProgram, machine: Machine, motion: Motion, angles: Floats, cuts: NDArray[np.bool_]
) -> list[Finding]:
    """Feed moves in which the rotary solution is not the one of the feed moves before; where both meet, at the pole and
    at the end of the reach, it is neither."""
    side = kinematics.solution_side(machine, angles)
    run = np.cumsum(
        np.append(True, ~cuts)
    )  # feed moves without another move between them have the same number
    clear = np.flatnonzero(motion.tcp & (np.abs(side) > SIDE_EPSILON))
    before, after = clear[:-1], clear[1:]
    changed = after[(run[before] == run[after]) & (side[before] * side[after] < 0)]
    message = "the rotary axes change to their other solution in a cut"
    return [_finding("continuity", program, motion, row, message) for row in changed.tolist()]


def _angles(motion: Motion, machine: Machine) -> Floats:
    """(K, 2) in the machine's order, from the part to the tool."""
    return np.column_stack([motion.angles[letter] for letter in machine.rotary_letters])


def _finding(check: str, program: ParsedProgram, motion: Motion, row: int, message: str) -> Finding:
    block = program.blocks[motion.block[row]]
    return Finding(check, block.number, block.text, message)


@dataclass(frozen=True)
class CheckResult:
    """All checks of a program. The errors are NaN when there was no CL list to compare with."""

    findings: list[Finding]
    tip_error_mm: float = float("nan")
    axis_error_deg: float = float("nan")

    @property
    def good(self) -> bool:
        return not self.findings


def check_program(
    program: ParsedProgram,
    machine: Machine,
    tip: Floats | None = None,
    axis: Floats | None = None,
    part_origin_mm: tuple[float, ...] | None = None,
    tool_length_mm: float | None = None,
) -> CheckResult:
    """All checks; against the CL list tip (N, 3), axis (N, 3) of the program's frame where it is given.

    part_origin_mm (of the set-up in the machine frame) and tool_length_mm: None takes the machine file's."""
    setup = machine.setup
    origin = setup.part_origin_mm if part_origin_mm is None else part_origin_mm
    length = setup.tool_length_mm if tool_length_mm is None else tool_length_mm
    findings = check_grammar(program) + check_state(program)
    findings += check_limits(program, machine, origin, length) + check_continuity(program, machine)
    if tip is None or axis is None:
        return CheckResult(findings)
    trip = check_round_trip(program, machine, tip, axis)
    return CheckResult(findings + trip.findings, trip.tip_error_mm, trip.axis_error_deg)
