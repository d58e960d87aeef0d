"""The job: everything that a plan depends on, as dataclasses and as a TOML file (docs/job-file.md)."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any, ClassVar

from . import checks, tools
from .checks import Vector, between, choice, inside, not_negative, positive
from .errors import InputError
from .sections import Section, key, read_toml, suggestion
from .tools import ToolSpec

# Names given when the job names none.
DEFAULT_METHOD = "exact"
DEFAULT_MACHINE = "dmu80p"
DEFAULT_POST = "dmu80p"

# Ways to measure the distance of two contacts: seen along the feed, or from one to the other.
ACROSS, DIRECT = "across", "direct"


@dataclass(frozen=True)
class Part(Section):
    """Which faces: those to machine (none named: all), and those to keep clear of (none named: all others)."""

    table: ClassVar[str] = "part"

    file: str = key(checks.path)
    faces: tuple[str, ...] = key(checks.texts, ())
    check_faces: tuple[str, ...] = key(checks.texts, ())


@dataclass(frozen=True)
class Setup(Section):
    """The set-up frame in the part's frame: origin (mm), z towards the spindle, x up to its part along z."""

    table: ClassVar[str] = "setup"

    origin: Vector = key(checks.vector, (0.0, 0.0, 0.0))
    z: Vector = key(checks.direction, (0.0, 0.0, 1.0))
    x: Vector = key(checks.direction, (1.0, 0.0, 0.0))

    def check_together(self) -> None:
        if checks.are_parallel(self.x, self.z):
            raise self.error("x", f"must not be parallel to z {list(self.z)}, got {list(self.x)}")


@dataclass(frozen=True)
class FootprintSpec(Section):
    """Where in plan the tool is to stand; `direction_deg` is the feed direction from the set-up's x axis. With
    `allow_gaps` a plan is good although it leaves out cuts between neighbours."""

    table: ClassVar[str] = "footprint"

    pattern: str = key(choice("raster"), "raster")
    direction_deg: float = key(checks.number("degrees"), 90.0)
    side_step_mm: float = key(positive("mm"), 18.0)
    forward_step_mm: float = key(positive("mm"), 2.0)
    zigzag: bool = key(checks.flag, False)
    margin_mm: float = key(checks.number("mm"), 0.0)
    allow_gaps: bool = key(checks.flag, False)


@dataclass(frozen=True)
class MethodSpec(Section):
    """How the tool is placed: the method's name, the spin, the tilt limit, and options of its own.

    With a `contact_spacing_mm` other than 0 every position gets the spin that sets its contacts so far apart.
    """

    table: ClassVar[str] = "method"

    name: str = key(checks.text, DEFAULT_METHOD)
    spin_deg: float = key(between(-180, 180, "degrees"), 0.0)
    contact_spacing_mm: float = key(not_negative("mm"), 0.0)
    spacing_measure: str = key(choice(ACROSS, DIRECT), ACROSS)
    tilt_max_deg: float = key(inside(0, 90, "degrees"), 45.0)
    options: dict[str, Any] = field(default_factory=dict, metadata={"check": checks.options})

    def check_together(self) -> None:
        if self.contact_spacing_mm and self.spin_deg:
            raise self.error(
                "spin_deg", f"must be 0 when a contact spacing chooses the spin, got {self.spin_deg:g}"
            )


@dataclass(frozen=True)
class Tolerance(Section):
    """What the plan may miss by: the depth of a gouge, and the chord of a move against the true path."""

    table: ClassVar[str] = "tolerance"

    gouge_mm: float = key(positive("mm"), 0.001)
    chord_mm: float = key(positive("mm"), 0.01)


@dataclass(frozen=True)
class LinkSpec(Section):
    """How the tool gets from one cut to the next."""

    table: ClassVar[str] = "link"

    safe_clearance_mm: float = key(
        positive("mm"), 5.0
    )  # between the part and the whole tool on the safe plane
    approach_distance_mm: float = key(positive("mm"), 2.0)  # how near to the part a rapid may come


@dataclass(frozen=True)
class MachineSpec(Section):
    table: ClassVar[str] = "machine"

    name: str = key(checks.text, DEFAULT_MACHINE)


@dataclass(frozen=True)
class PostSpec(Section):
    """The program's dialect, its name, and the feeds and speed in it."""

    table: ClassVar[str] = "post"

    name: str = key(checks.text, DEFAULT_POST)
    program_name: str = key(checks.text, "MPM01")
    tool_number: int = key(checks.whole(1, 99999), 1)
    spindle_rpm: float = key(positive("turns per minute"), 8000.0)
    cut_feed_mm_per_min: float = key(positive("mm/min"), 1000.0)
    plunge_feed_mm_per_min: float = key(positive("mm/min"), 300.0)
    tcp: bool = key(checks.flag, True)  # the control holds the tip; false: the program moves the joints
    options: dict[str, Any] = field(default_factory=dict, metadata={"check": checks.options})


_TABLES: tuple[type[Section], ...] = (
    Part,
    Setup,
    ToolSpec,
    FootprintSpec,
    MethodSpec,
    Tolerance,
    LinkSpec,
    MachineSpec,
    PostSpec,
)
SECTIONS = {one.table: one for one in _TABLES}


@dataclass(frozen=True)
class Job:
    part: Part
    tool: ToolSpec
    setup: Setup = Setup()
    footprint: FootprintSpec = FootprintSpec()
    method: MethodSpec = MethodSpec()
    tolerance: Tolerance = Tolerance()
    link: LinkSpec = LinkSpec()
    machine: MachineSpec = MachineSpec()
    post: PostSpec = PostSpec()
    source: str = field(default="job", compare=False)  # put in front of messages: the file it came from

    def error(self, table: str, name: str, message: str) -> InputError:
        return InputError(f"{self.source}: [{table}] {name}: {message}")


def load(path: str | Path) -> Job:
    """The job of a TOML file; relative paths in it start at its folder.

    Raises InputError that names the file and the key, says what is wrong and what would be right."""
    path = Path(path)
    tables = read_toml(path)
    try:
        return replace(from_tables(tables, path.parent), source=str(path))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def from_tables(tables: Mapping[str, Any], folder: Path) -> Job:
    """The job of parsed TOML tables; `folder` is where relative paths start."""
    for name in tables:
        if name not in SECTIONS:
            raise InputError(f"[{name}]: unknown table{suggestion(name, SECTIONS)}")
    for name in ("part", "tool"):
        if name not in tables:
            raise InputError(f"[{name}]: is missing")
    sections: dict[str, Any] = {
        name: SECTIONS[name].from_table(tables[name]) for name in tables if name != "tool"
    }
    part = sections.pop("part")
    if not part.file:
        raise Part.error("file", "must be the name of a STEP, IGES, BREP or Bézier text file, got ''")
    return Job(
        part=replace(part, file=os.path.join(folder, part.file)),
        tool=tools.resolve(tables["tool"], folder),
        **sections,
    )


def dump(job: Job) -> str:
    """The job as TOML, every key written out; `load` of it gives an equal job."""
    return "\n".join(_table(getattr(job, name)) for name in SECTIONS)


def _table(section: Section) -> str:
    lines = [f"{one.name} = {_toml(getattr(section, one.name))}" for one in fields(section)]
    return "\n".join([f"[{section.table}]", *lines, ""])


def _toml(value: Any) -> str:
    if isinstance(value, Section):
        value = {one.name: getattr(value, one.name) for one in fields(value)}
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_toml(str(name))} = {_toml(one)}" for name, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    # JSON's strings, numbers and booleans are TOML's too; DEL alone must be escaped in TOML.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
