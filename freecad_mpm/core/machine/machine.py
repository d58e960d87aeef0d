"""Machines: TOML files (resources/machines) with every number of the kinematic chain.

Names follow FreeCAD's machine model; docs/machine.md explains frames and signs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import numpy as np

from ... import _core
from ..base import (
    MACHINES,
    Check,
    Floats,
    InputError,
    Table,
    Vector,
    blame,
    choice,
    flag,
    key,
    not_negative,
    number,
    positive,
    read_toml,
    text,
    values,
    vector,
)

S = TypeVar("S", bound=Table)


def limit(unit: str) -> Check:
    """A number of which an axis may also have none: inf or -inf."""
    return _or_infinite(number(unit), (math.inf, -math.inf))


def positive_or_none(unit: str) -> Check:
    """A positive number that an axis may also not know: inf."""
    return _or_infinite(positive(unit), (math.inf,))


def _or_infinite(check: Check, taken: tuple[float, ...]) -> Check:
    return replace(check, take=lambda value: value if value in taken else check(value))


def one(kind: type[S]) -> Check:
    """A table of this kind."""
    return Check(kind, "a table", lambda value: value if isinstance(value, kind) else kind.from_table(value))


def several(kind: type[S], count: int) -> Check:
    """A list of so many tables of this kind."""

    def take(value: Any) -> tuple[S, ...] | None:
        if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != count:
            return None
        return tuple(one(kind)(entry) for entry in value)

    return Check(tuple, f"{count} tables [[{kind.table}]]", take)


SENSE = Check(int, "1 or -1", lambda value: value if type(value) is int and value in (1, -1) else None)


@dataclass(frozen=True, kw_only=True)
class LinearAxis(Table):
    """X, Y or Z: position of the spindle gauge point in the machine frame with both rotary axes at zero."""

    table: ClassVar[str] = "linear_axes"

    name: str = key(choice("X", "Y", "Z"))
    min_limit_mm: float = key(limit("mm"), -math.inf)
    max_limit_mm: float = key(limit("mm"), math.inf)
    max_velocity_mm_per_min: float = key(positive("mm/min"))
    max_acceleration_mm_per_s2: float = key(positive("mm/s2"))
    max_jerk_mm_per_s3: float = key(positive_or_none("mm/s3"), math.inf)

    def native(self) -> _core.LinearAxis:
        """Without name and jerk, which no inverse kinematics needs."""
        return _core.LinearAxis(
            **{k: v for k, v in vars(self).items() if k not in ("name", "max_jerk_mm_per_s3")}
        )


@dataclass(frozen=True, kw_only=True)
class RotaryAxis(Table):
    """A rotary axis; limits of -inf and inf make it unwound."""

    table: ClassVar[str] = "rotary_axes"

    name: str = key(choice("A", "B", "C"))
    role: str = key(choice("table_rotary", "head_rotary"))
    rotation_vector: Vector = key(values.direction)
    joint_origin_mm: Vector = key(vector, (0.0, 0.0, 0.0))
    sense: int = key(SENSE, 1)
    zero_offset_deg: float = key(number("degrees"), 0.0)
    min_limit_deg: float = key(limit("degrees"), -math.inf)
    max_limit_deg: float = key(limit("degrees"), math.inf)
    max_velocity_deg_per_min: float = key(positive("degrees per minute"))
    max_acceleration_deg_per_s2: float = key(positive("degrees per s2"))
    max_jerk_deg_per_s3: float = key(positive_or_none("degrees per s3"), math.inf)

    def native(self) -> _core.RotaryAxis:
        """Without the jerk, which no inverse kinematics needs; angles stay in degrees."""
        return _core.RotaryAxis(**{k: v for k, v in vars(self).items() if k != "max_jerk_deg_per_s3"})


@dataclass(frozen=True, kw_only=True)
class Kinematics(Table):
    """How the chain is driven: which of several joint positions is taken, and how far a rotary axis may go in a
    step."""

    table: ClassVar[str] = "kinematics"

    spindle_axis: Vector = key(values.direction, (0.0, 0.0, 1.0))
    solution_preference: str = key(choice("shortest", "positive", "negative"), "shortest")
    allow_flip: bool = key(flag, True)
    pole_cone_deg: float = key(not_negative("degrees"), 0.0)
    max_rotary_step_deg: float = key(positive("degrees"), 180.0)


@dataclass(frozen=True, kw_only=True)
class MachineSetup(Table):
    """Where the part stands on the machine, how long the tool is and where it is changed."""

    table: ClassVar[str] = "setup"

    part_origin_mm: Vector = key(vector, (0.0, 0.0, 0.0))
    tool_length_mm: float = key(not_negative("mm"), 0.0)
    retract_z_mm: float = key(number("mm"), 0.0)

    def native(self) -> _core.PartSetup:
        """In mm, the part's origin in the machine frame with the table at zero."""
        return _core.PartSetup(part_origin_mm=self.part_origin_mm, tool_length_mm=self.tool_length_mm)


@dataclass(frozen=True, kw_only=True)
class MachineControl(Table):
    """How the control takes its blocks; only the estimated time knows of it."""

    table: ClassVar[str] = "control"

    block_time_ms: float = key(not_negative("ms"), 0.0)
    stops_at_blocks: bool = key(flag, False)


@dataclass(frozen=True, kw_only=True)
class Machine(Table):
    """One machine file. `rotary_axes` are listed from the part to the tool, `linear_axes` are X, Y, Z."""

    table: ClassVar[str] = "machine"

    name: str = key(text)
    description: str = key(text)
    unconfirmed: bool = key(flag)
    kinematics: Kinematics = key(one(Kinematics))
    setup: MachineSetup = key(one(MachineSetup))
    control: MachineControl = key(one(MachineControl), MachineControl())
    rotary_axes: tuple[RotaryAxis, ...] = key(several(RotaryAxis, 2))
    linear_axes: tuple[LinearAxis, ...] = key(several(LinearAxis, 3))

    @classmethod
    def error(cls, name: str, message: str) -> InputError:
        """To be raised: names the key; its file is put in front by who reads it."""
        return InputError(f"{name}: {message}")  # the keys stand at the top of the file, in no table

    def check_together(self) -> None:
        """Raises InputError for linear axes that are not X, Y, Z, and for axes that make no five-axis machine."""
        if [axis.name for axis in self.linear_axes] != ["X", "Y", "Z"]:
            raise self.error("linear_axes", "must be X, Y and Z in this order")
        with blame("kinematics:"):
            self.chain()

    def chain(self) -> _core.KinematicChain:
        """The native chain. Raises InputError when the axes do not make a five-axis machine."""
        kinematics = self.kinematics
        return _core.KinematicChain(
            rotary=[axis.native() for axis in self.rotary_axes],
            linear=[axis.native() for axis in self.linear_axes],
            spindle_axis=kinematics.spindle_axis,
            solution_preference=kinematics.solution_preference,
            allow_flip=kinematics.allow_flip,
        )

    @property
    def datum_mm(self) -> Floats:
        """(3,) what a control without tool-centre-point control takes off X, Y and Z: datum and tool length."""
        spindle = np.array(self.kinematics.spindle_axis) / np.linalg.norm(self.kinematics.spindle_axis)
        return np.asarray(np.array(self.setup.part_origin_mm) + self.setup.tool_length_mm * spindle)

    @property
    def rotary_letters(self) -> tuple[str, str]:
        """Names of the rotary axes, from the part to the tool."""
        return self.rotary_axes[0].name, self.rotary_axes[1].name


def names() -> list[str]:
    """The shipped machines."""
    return sorted(path.stem for path in MACHINES.glob("*.toml"))


def load(name_or_path: str | Path) -> Machine:
    """A shipped machine by its name, or one from a TOML file. Raises InputError naming the file and the key."""
    path = find(name_or_path)
    table = read_toml(path)
    try:
        return Machine.from_table(table)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def find(name_or_path: str | Path) -> Path:
    """The file that is meant: a shipped machine goes before a file of that name."""
    if str(name_or_path) in names():
        return MACHINES / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if not path.is_file():
        raise InputError(
            f"machine '{name_or_path}': unknown; give one of {', '.join(names())} or the path of a TOML file"
        )
    return path
