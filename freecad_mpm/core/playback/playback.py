"""A tool path played back: where tool and machine are at any moment, by time, by way or by position."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..base import Floats, Integers, Names
from ..control import kinematics
from ..machine import JointPath, Machine, move_seconds
from .bodies import body_matrices, seen_from_part

# A path that takes no time at all has no mean speed.
LEAST_SECONDS = 1e-9


@dataclass(frozen=True)
class Moment:
    """What there is to show at one place of the path; set-up frame."""

    move: int  # of the given path, under way or just ended
    kind: str
    seconds: float  # since the start
    tip: Floats  # (3,) mm
    axis: Floats  # (3,)
    rotary_deg: Floats  # (2,) readings of the rotary axes
    linear_mm: Floats  # (3,) readings of X, Y, Z
    joint_status: str  # of _core.JOINT_STATUS


@dataclass(frozen=True)
class Visited:
    """The K positions of a path in machining order."""

    move: Integers  # (K,): the move of the given path that ends in the position
    status: Names  # (K,)
    clearance_mm: Floats  # (K,): upper bound of the distance to the faces; NaN: unknown


@dataclass(frozen=True)
class Playback:
    """The machine's blocks, and when each ends.

    A *place* is a real number: 7 is the end of block 7, 7.25 a quarter of block 8 further. Within a block the tip
    runs straight and both rotary axes evenly, as a control that holds the tip on its line (TCPM) has it."""

    machine: Machine
    blocks: JointPath
    visited: Visited
    seconds: Floats  # (B,): when each block ends
    way_mm: Floats  # (B,): of the tip until then
    position_block: Integers  # (K,): the block that ends in each position

    @property
    def last(self) -> float:
        """The place where the path ends; it starts at 0."""
        return float(len(self.blocks) - 1)

    def at_seconds(self, seconds: float) -> float:
        """The place after so much time; before the start and after the end the nearest of both."""
        return float(np.interp(seconds, self.seconds, np.arange(len(self.blocks))))

    def at_way(self, way_mm: float) -> float:
        """The place after so much way of the tip."""
        return float(np.interp(way_mm, self.way_mm, np.arange(len(self.blocks))))

    def at_position(self, number: int) -> float:
        """The place of a position by its number in machining order, from 0."""
        return float(self.position_block[number])

    def at_move(self, move: int) -> float:
        """The place where a move of the given path ends."""
        return float(np.searchsorted(self.blocks.move, move, side="right")) - 1.0

    def seconds_at(self, place: float) -> float:
        """Machine time from the start; held at both ends of the path."""
        return float(np.interp(place, np.arange(len(self.blocks)), self.seconds))

    def way_at(self, place: float) -> float:
        """Way of the tip from the start, mm; held at both ends of the path."""
        return float(np.interp(place, np.arange(len(self.blocks)), self.way_mm))

    def advance(self, place: float, seconds: float, evenly: bool = False) -> float:
        """The place so much time later; evenly: the tip at its mean speed all along, instead of the machine's pace."""
        if not evenly:
            return self.at_seconds(self.seconds_at(place) + seconds)
        mean_mm_per_s = self.way_mm[-1] / max(self.seconds[-1], LEAST_SECONDS)
        return self.at_way(self.way_at(place) + seconds * mean_mm_per_s)

    def position_before(self, place: float) -> int:
        """Number of the last position that was reached; -1 before the first."""
        return int(np.searchsorted(self.position_block, place, side="right")) - 1

    def position_after(self, place: float) -> int:
        """Number of the next position that will be reached; the last one when there is none."""
        following = int(np.searchsorted(self.position_block, place, side="right"))
        return min(following, len(self.position_block) - 1)

    def moment(self, place: float) -> Moment:
        """Between two blocks tip and rotary angles in proportion, the linear axes from them; held at both ends of
        the path."""
        place = float(np.clip(place, 0.0, self.last))
        before = min(int(place), max(len(self.blocks) - 2, 0))
        after = min(before + 1, len(self.blocks) - 1)
        part = place - before
        under_way = after if part > 0 else before
        tip, angles = (
            _between(rows, before, after, part) for rows in (self.blocks.tip, self.blocks.rotary_deg)
        )
        setup = self.machine.setup
        origin = np.asarray(setup.part_origin_mm)
        linear = kinematics.linear_readings(
            self.machine, tip[None], angles[None], origin, setup.tool_length_mm
        )
        return Moment(
            move=int(self.blocks.move[under_way]),
            kind=str(self.blocks.kind[under_way]),
            seconds=self.seconds_at(place),
            tip=tip,
            axis=kinematics.tool_axes(self.machine, angles[None])[0],
            rotary_deg=angles,
            linear_mm=linear[0],
            joint_status=str(self.blocks.status[under_way]),
        )

    def body_matrices(self, moment: Moment, part_fixed: bool) -> dict[str, Floats]:
        """Body -> matrix (4, 4) as `bodies.body_matrices`, or as seen from the part."""
        bodies = body_matrices(self.machine, moment.rotary_deg, moment.linear_mm)
        return seen_from_part(bodies) if part_fixed else bodies


def make_playback(machine: Machine, blocks: JointPath, visited: Visited) -> Playback:
    """blocks: what `machine_path` made of the path whose moves `visited` counts."""
    ends = np.searchsorted(blocks.move, visited.move, side="right") - 1  # the last block of each move
    steps = np.linalg.norm(np.diff(blocks.tip, axis=0, prepend=blocks.tip[:1]), axis=1)
    seconds = move_seconds(machine, blocks, blocks.linear_mm)
    seconds[:1] = 0.0  # the path starts at the end of its first block
    return Playback(machine, blocks, visited, np.cumsum(seconds), np.cumsum(steps), ends)


def describe(played: Playback, place: float) -> dict[str, str]:
    """What people are shown of a place, name -> value; always the same names in the same order."""
    moment = played.moment(place)
    number = played.position_before(place)
    machine, visited = played.machine, played.visited
    linear = {axis.name: f"{value:.3f} mm" for axis, value in zip(machine.linear_axes, moment.linear_mm)}
    rotary = {axis.name: f"{value:.3f}°" for axis, value in zip(machine.rotary_axes, moment.rotary_deg)}
    return {
        "Position": f"{number + 1} of {len(visited.move)}",
        "Status": str(visited.status[number]).replace("_", " ") if number >= 0 else "none reached yet",
        "Clearance": _micrometres(visited.clearance_mm[number] if number >= 0 else np.nan),
        "Move": f"{moment.move + 1}, {moment.kind}",
        "Time": f"{_clock(moment.seconds)} of {_clock(played.seconds[-1])}",
        **linear,
        **rotary,
        "Joints": moment.joint_status.replace("_", " "),
    }


def _micrometres(length_mm: float) -> str:
    return "unknown" if np.isnan(length_mm) else f"{round(1000 * length_mm, 2) + 0.0:.2f} µm"


def _clock(seconds: float) -> str:
    minutes, rest = divmod(seconds, 60.0)
    return f"{int(minutes)}:{rest:04.1f}"


def _between(rows: Floats, before: int, after: int, part: float) -> Floats:
    return np.asarray((1.0 - part) * rows[before] + part * rows[after])
