"""From a tool path to moves of the machine: joint values, finer blocks where needed, safe rapids."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ... import _core
from ..base import Flags, Floats, Integers, Names
from ..job import Job, PostSpec, control_deviation_deg, control_tip_deviation_mm
from ..path import ToolPath
from .machine import Machine
from .moves import Moves

# Rotary readings this near are the same position: far under the 0.0001 degrees that controls resolve.
SAME_ANGLE_DEG = 1e-9

OFF_LINE = "off_line"
# What is wrong, and what a user can do about it.
TROUBLE = {
    "unreachable": (
        "the rotary axes cannot give the tool's direction",
        "tilt the set-up, or lessen tilt_max_deg; along the first rotary axis itself: a larger pole_cone_deg",
    ),
    "rotary_limit": (
        "a rotary axis leaves its limits",
        "turn the set-up or the feed direction; an axis of less than a whole turn cannot rewind",
    ),
    "linear_limit": ("a linear axis leaves its limits", "move the part: part_origin_mm of the machine"),
    "forced_turn": (
        "the cut needs a rewind or the other rotary solution",
        "turn the set-up or the feed direction, or allow_flip; an axis of less than a whole turn cannot rewind",
    ),
    OFF_LINE: (
        "between its ends the tool leaves its way by more than the tolerance",
        "raise chord_mm",
    ),
}
# Under the end of the Z axis, where a machine without tool-centre-point control turns out of the part's way; over the
# program's highest place when the axis has no end.
BELOW_END_MM = 1.0
ABOVE_ALL_MM = 100.0


@dataclass(frozen=True)
class JointPath(Moves):
    """Moves with what the machine does in them. Rows that were inserted keep the given row in `move`."""

    linear_mm: Floats  # (M, 3) readings of X, Y, Z: the spindle gauge point in the machine frame
    move: Integers  # (M,) index of the given move that the move is part of
    status: Names  # (M,) of _core.JOINT_STATUS, or OFF_LINE
    at_pole: Flags  # (M,) inside the machine's pole cone: the first rotary axis follows its neighbours

    def troubles(self, position: Integers | None = None) -> list[str]:
        """One line for each kind of trouble: how many moves have it, the first given move that has, and a remedy.

        position: (N,) of the given moves, as in a plan's path: the line then also names the position that is near.
        """
        lines = []
        for status, (meaning, remedy) in TROUBLE.items():
            rows = np.flatnonzero(self.status == status)
            if len(rows):
                first = int(self.move[rows[0]])
                at = "" if position is None else _near(position, first)
                lines.append(f"{meaning}: {len(rows)} moves, the first in move {first}{at} ({remedy})")
        return lines


def _near(position: Integers, move: int) -> str:
    """Words for the last position up to a move, or the first of all."""
    named = np.flatnonzero(position >= 0)
    if not len(named):
        return ""
    before = named[named <= move]
    return f" at position {position[before[-1] if len(before) else named[0]]}"


@dataclass(frozen=True)
class _Rows:
    """The given moves with each rapid in two: a turn with the tip held, and a travel with the angles held."""

    tip: Floats
    axis: Floats
    move: Integers
    turns_first: Flags  # first row of a rapid that turns, then travels
    travels_first: Flags  # first row of a rapid that travels, then turns
    held: Flags  # no change of the rotary solution in this row


def joint_path(
    machine: Machine,
    kind: Names,
    tip: Floats,
    axis: Floats,
    feed_mm_per_min: Floats,
    *,
    axis_tolerance_deg: float,
    tip_tolerance_mm: float | None = None,
) -> JointPath:
    """Joint values for a path of M moves (kind (M,), tip (M, 3) and axis (M, 3) in the set-up frame).

    Feed moves are split until, with both rotary axes running evenly, the tool stays within `axis_tolerance_deg` of the
    great circle between two given directions. Rapids never turn and travel in one block: the tool turns at the
    higher end of the rapid with its tip held, where the path must be clear of the part; only there may the rotary
    solution change. All given poses are kept, in order. Limits that cannot be kept are statuses, not errors.

    Raises ValueError naming the argument."""
    tcp = tip_tolerance_mm is None
    rows = _with_rapids_in_two(kind, tip, axis) if tcp else _as_given(kind, tip, axis)
    joints = _core.refine_path(
        machine.chain(),
        rows.tip,
        rows.axis,
        rows.held,
        setup=machine.setup.native(),
        tip_tolerance_mm=np.inf if tip_tolerance_mm is None else tip_tolerance_mm,
        pole_cone_deg=machine.kinematics.pole_cone_deg,
        axis_tolerance_deg=axis_tolerance_deg,
        max_rotary_step_deg=machine.kinematics.max_rotary_step_deg,
    )
    row = joints["source"].astype(np.int64)
    keep = ~_redundant(joints["rotary_deg"], joints["tip"], rows.turns_first[row], rows.travels_first[row])
    move = rows.move[row[keep]]
    status = np.array(_core.JOINT_STATUS + (OFF_LINE,))[joints["status"][keep]]
    status[(status == "ok") & ~joints["keeps"][keep] & (kind[move] != "rapid")] = OFF_LINE
    path = JointPath(
        kind=kind[move],
        tip=joints["tip"][keep],
        axis=joints["axis"][keep],
        rotary_deg=joints["rotary_deg"][keep],
        feed_mm_per_min=feed_mm_per_min[move],
        linear_mm=joints["linear_mm"][keep],
        move=move,
        status=status,
        at_pole=joints["at_pole"][keep],
    )
    return path if tcp else _with_turns_at_the_top(machine, path, joints["keeps"][keep])


def _with_turns_at_the_top(machine: Machine, path: JointPath, keeps: Flags) -> JointPath:
    """Before each rapid whose joints would swing the tip off its way: up along Z, the turn, and across, so that the
    rapid itself only goes down."""
    turns = np.flatnonzero(~keeps & (path.kind == "rapid"))
    if not len(turns):
        return path
    limit = machine.linear_axes[2].max_limit_mm
    z = path.linear_mm[:, 2].max() + ABOVE_ALL_MM if np.isinf(limit) else limit - BELOW_END_MM
    before = np.repeat(turns - 1, 3)
    before[2::3] = before[1::3] = turns
    linear, angles = path.linear_mm[before], path.rotary_deg[before]
    linear[1::3] = path.linear_mm[turns - 1]
    linear[:, 2] = np.maximum(z, linear[:, 2])
    angles[0::3] = path.rotary_deg[turns - 1]
    tip, axis = machine.chain().forward(linear, angles, setup=machine.setup.native())
    given = np.repeat(turns, 3)
    inserted = {"tip": tip, "axis": axis, "linear_mm": linear, "rotary_deg": angles}
    columns = {
        one.name: np.insert(
            getattr(path, one.name), given, inserted.get(one.name, getattr(path, one.name)[given]), axis=0
        )
        for one in fields(JointPath)
    }
    return JointPath(**columns)


def _as_given(kind: Names, tip: Floats, axis: Floats) -> _Rows:
    none = np.zeros(len(kind), dtype=bool)
    return _Rows(tip, axis, np.arange(len(kind)), none, none, held=kind != "rapid")


def _with_rapids_in_two(kind: Names, tip: Floats, axis: Floats) -> _Rows:
    in_two = kind == "rapid"
    in_two[:1] = False
    move = np.repeat(np.arange(len(kind)), np.where(in_two, 2, 1))
    first = np.zeros(len(move), dtype=bool)
    first[:-1] = move[:-1] == move[1:]
    before = np.maximum(move - 1, 0)
    falls = tip[before, 2] >= tip[move, 2]
    turns_first, travels_first = first & falls, first & ~falls
    # Held are feed moves and the travelling row: the second of a pair that turns first, the first of one that does not.
    turning = turns_first | np.roll(travels_first, 1)
    turning[:1] = True
    return _Rows(
        tip=tip[np.where(turns_first, before, move)],
        axis=axis[np.where(travels_first, before, move)],
        move=move,
        turns_first=turns_first,
        travels_first=travels_first,
        held=~turning,
    )


def _redundant(rotary_deg: Floats, tip: Floats, turns_first: Flags, travels_first: Flags) -> Flags:
    """First rows of rapids that do not turn, or do not travel: their second row does it all."""
    turn = np.abs(np.diff(rotary_deg, axis=0)).max(axis=1, initial=0.0) > SAME_ANGLE_DEG
    travel = np.any(np.diff(tip, axis=0) != 0, axis=1)
    before, after = np.append(False, turn), np.append(turn, False)
    travel_before, travel_after = np.append(False, travel), np.append(travel, False)
    by_turn, by_travel = turns_first & ~(before & travel_after), travels_first & ~(after & travel_before)
    return np.asarray(by_turn | by_travel)


def move_machine(
    job: Job, machine: Machine, path: ToolPath, feed_mm_per_min: Floats | None = None
) -> JointPath:
    """The machine's joints along a path in the set-up frame, with the moves that keep the chord tolerance; feeds (M,) of
    the moves: None takes the job's."""
    return joint_path(
        machine,
        path.kind,
        path.tip,
        path.axis,
        feeds(job.post, path.kind) if feed_mm_per_min is None else feed_mm_per_min,
        axis_tolerance_deg=control_deviation_deg(job),
        tip_tolerance_mm=None if job.post.tcp else control_tip_deviation_mm(job),
    )


def feeds(post: PostSpec, kind: Names) -> Floats:
    """(M,) feeds of moves of these kinds, mm/min."""
    return np.where(np.isin(kind, ("cut", "link")), post.cut_feed_mm_per_min, post.plunge_feed_mm_per_min)


def axes_of(machine: Machine, joints: JointPath) -> Floats:
    """(M, 3) X, Y and Z as a control without tool-centre-point control counts them."""
    return joints.linear_mm - machine.datum_mm
