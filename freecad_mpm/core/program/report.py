"""What a program does, in figures: lengths, times, ranges of the axes, and how its text was proven."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..base import Floats
from ..control import CheckResult, kinematics
from ..machine import MOVE_KINDS, SECONDS_PER_MINUTE, Machine, Moves, move_seconds
from ..posts import Program

# A cut that comes this near to the pole makes the first rotary axis race: it counts as a passage.
POLE_ZONE_DEG = 0.5
# So many findings are listed; the rest is counted.
LISTED_FINDINGS = 10


@dataclass(frozen=True)
class AxisUse:
    """Least and greatest reading of an axis in the moves, and its limits; mm or degrees."""

    low: float
    high: float
    min_limit: float
    max_limit: float


@dataclass(frozen=True)
class ProgramReport:
    """What JSON and people get of a program; lengths, angles and times in the units that the names say."""

    blocks: int
    length_mm: dict[str, float]  # by kind of move
    time_s: dict[str, float]  # by kind of move, with the axes' accelerations
    axes: dict[str, AxisUse]  # X, Y, Z and the rotary axes
    largest_step_deg: dict[str, float]  # by rotary axis, in feed moves
    pole_passages: int
    nearest_to_pole_deg: float
    tip_error_mm: float  # of the text read back, against the CL list
    axis_error_deg: float
    tip_between_mm: float  # off its line between two blocks; 0 where the control holds it
    axis_between_deg: float  # off its great circle
    findings: list[str]

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON, where infinite limits and unknown errors become None."""
        return {name: _plain(value) for name, value in asdict(self).items()}

    def lines(self) -> list[str]:
        """The same as text."""
        kinds = [kind for kind in MOVE_KINDS if self.time_s[kind] > 0]
        moves = ", ".join(
            f"{kind} {self.length_mm[kind]:.0f} mm {_clock(self.time_s[kind])}" for kind in kinds
        )
        steps = ", ".join(f"{name} {step:.3f}" for name, step in self.largest_step_deg.items())
        listed = self.findings[:LISTED_FINDINGS]
        more = len(self.findings) - len(listed)
        return [
            f"Program: {self.blocks} blocks, about {_clock(sum(self.time_s.values()))}, "
            f"of it cutting {_clock(self.time_s['cut'])}, rapid {_clock(self.time_s['rapid'])}",
            f"Moves: {moves}",
            *(f"Axis {name}: {_use(use)}" for name, use in self.axes.items()),
            f"Largest rotary step in a feed move (deg): {steps}",
            f"Pole: {self.pole_passages} passages under {POLE_ZONE_DEG:g} deg, "
            f"nearest {self.nearest_to_pole_deg:.3f} deg",
            f"Text parsed back: {self._errors()}",
            f"Between the blocks: tip off its line <= {self.tip_between_mm:.6f} mm, "
            f"axis off its great circle <= {self.axis_between_deg:.6f} deg",
            f"Checks: {'passed' if not self.findings else f'{len(self.findings)} findings'}",
            *(f"  {finding}" for finding in listed),
            *([f"  and {more} more"] if more else []),
        ]

    def _errors(self) -> str:
        if np.isnan(self.tip_error_mm):
            return "not compared with a CL list"
        return f"tip error <= {self.tip_error_mm:.6f} mm, axis error <= {self.axis_error_deg:.6f} deg"


def report(
    program: Program,
    blocks: int,
    checks: CheckResult,
) -> ProgramReport:
    """Figures of a program of so many blocks whose text was checked."""
    machine, moves = program.machine, program.moves
    setup = machine.setup
    origin = np.array(setup.part_origin_mm)
    linear = kinematics.linear_readings(machine, moves.tip, moves.rotary_deg, origin, setup.tool_length_mm)
    blends = program.options.path_tolerance_mm > 0
    passages, nearest = _pole_passages(machine, moves)
    return ProgramReport(
        blocks=blocks,
        length_mm=_by_kind(moves, _steps(moves.tip)),
        time_s=_by_kind(moves, move_seconds(machine, moves, linear, blends)),
        axes=_axis_use(machine, moves, linear),
        largest_step_deg=_largest_steps(machine, moves),
        pole_passages=passages,
        nearest_to_pole_deg=nearest,
        tip_error_mm=checks.tip_error_mm,
        axis_error_deg=checks.axis_error_deg,
        tip_between_mm=checks.tip_between_mm,
        axis_between_deg=checks.axis_between_deg,
        findings=[str(finding) for finding in checks.findings],
    )


def _steps(points: Floats) -> Floats:
    """Length of each move (M,); the first has no start."""
    return np.asarray(np.linalg.norm(np.diff(points, axis=0, prepend=points[:1]), axis=1))


def _by_kind(moves: Moves, values: Floats) -> dict[str, float]:
    return {kind: float(values[moves.kind == kind].sum()) for kind in MOVE_KINDS}


def _axis_use(machine: Machine, moves: Moves, linear_mm: Floats) -> dict[str, AxisUse]:
    uses = {}
    for k, linear in enumerate(machine.linear_axes):
        low, high = float(linear_mm[:, k].min()), float(linear_mm[:, k].max())
        uses[linear.name] = AxisUse(low, high, linear.min_limit_mm, linear.max_limit_mm)
    for k, rotary in enumerate(machine.rotary_axes):
        low, high = float(moves.rotary_deg[:, k].min()), float(moves.rotary_deg[:, k].max())
        uses[rotary.name] = AxisUse(low, high, rotary.min_limit_deg, rotary.max_limit_deg)
    return uses


def _largest_steps(machine: Machine, moves: Moves) -> dict[str, float]:
    steps = np.abs(np.diff(moves.rotary_deg, axis=0))[~moves.is_rapid[1:]]
    return dict(zip(machine.rotary_letters, steps.max(axis=0, initial=0.0).tolist()))


def _pole_passages(machine: Machine, moves: Moves) -> tuple[int, float]:
    """Runs of feed moves in the pole zone, and the least distance (degrees) of any feed move from the pole."""
    pole = np.array(machine.rotary_axes[0].rotation_vector)
    pole = pole / np.linalg.norm(pole)
    axes = moves.axis * np.where(moves.axis @ pole < 0, -1.0, 1.0)[:, None]  # both ends of the line are poles
    start, way = axes[:-1], np.diff(axes, axis=0)
    length2 = np.einsum("ij,ij->i", way, way)
    along = np.einsum("ij,ij->i", pole - start, way) / np.where(length2 > 0, length2, 1.0)
    nearest = start + np.clip(along, 0.0, 1.0)[:, None] * way
    distance = kinematics.pole_distance_deg(machine, nearest)
    distance = np.where(moves.is_rapid[1:], np.inf, distance)
    inside = distance < POLE_ZONE_DEG
    runs = int(np.count_nonzero(inside & ~np.append(False, inside[:-1])))
    return runs, float(distance.min(initial=np.inf))


def _use(use: AxisUse) -> str:
    limits = (
        "no limits"
        if np.isinf([use.min_limit, use.max_limit]).all()
        else f"{use.min_limit:g} .. {use.max_limit:g}"
    )
    return f"{use.low:.3f} .. {use.high:.3f} of {limits}"


def _clock(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), SECONDS_PER_MINUTE)
    return f"{int(minutes)} min {int(rest)} s" if minutes else f"{seconds:.1f} s"


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: _plain(one) for name, one in value.items()}
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value
