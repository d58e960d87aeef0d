"""The job: everything that a plan depends on, as dataclasses and as a TOML file (docs/job-file.md)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, ClassVar

from ..base import InputError, Table, Vector, between, choice, inside, key, not_negative, positive, values
from .tool import ToolSpec

# Names given when the job names none.
DEFAULT_METHOD = "exact"
DEFAULT_MACHINE = "dmu80p"
DEFAULT_POST = "dmu80p"

# Ways to measure the distance of two contacts: seen along the feed, or from one to the other.
ACROSS, DIRECT = "across", "direct"


@dataclass(frozen=True)
class Part(Table):
    """Which faces: those to machine (none named: all), and those to keep clear of (none named: all others)."""

    table: ClassVar[str] = "part"

    file: str = key(values.path)
    faces: tuple[str, ...] = key(values.texts, ())
    check_faces: tuple[str, ...] = key(values.texts, ())


@dataclass(frozen=True)
class Setup(Table):
    """The set-up frame in the part's frame: origin (mm), z towards the spindle, x up to its part along z."""

    table: ClassVar[str] = "setup"

    origin: Vector = key(values.vector, (0.0, 0.0, 0.0))
    z: Vector = key(values.direction, (0.0, 0.0, 1.0))
    x: Vector = key(values.direction, (1.0, 0.0, 0.0))

    def check_together(self) -> None:
        if values.are_parallel(self.x, self.z):
            raise self.error("x", f"must not be parallel to z {list(self.z)}, got {list(self.x)}")


@dataclass(frozen=True)
class FootprintSpec(Table):
    """Where in plan the tool is to stand; `direction_deg` is the feed direction from the set-up's x axis. With
    `allow_gaps` a plan is good although it leaves out cuts between neighbours."""

    table: ClassVar[str] = "footprint"

    pattern: str = key(choice("raster"), "raster")
    direction_deg: float = key(values.number("degrees"), 90.0)
    side_step_mm: float = key(positive("mm"), 18.0)
    forward_step_mm: float = key(positive("mm"), 2.0)
    zigzag: bool = key(values.flag, False)
    margin_mm: float = key(values.number("mm"), 0.0)
    allow_gaps: bool = key(values.flag, False)


@dataclass(frozen=True)
class MethodSpec(Table):
    """How the tool is placed: the method's name, the spin, the tilt limit, and options of its own.

    With a `contact_spacing_mm` other than 0 every position gets the spin that sets its contacts so far apart.
    """

    table: ClassVar[str] = "method"

    name: str = key(values.text, DEFAULT_METHOD)
    spin_deg: float = key(between(-180, 180, "degrees"), 0.0)
    contact_spacing_mm: float = key(not_negative("mm"), 0.0)
    spacing_measure: str = key(choice(ACROSS, DIRECT), ACROSS)
    tilt_max_deg: float = key(inside(0, 90, "degrees"), 45.0)
    options: dict[str, Any] = field(default_factory=dict, metadata={"check": values.options})

    def check_together(self) -> None:
        if self.contact_spacing_mm and self.spin_deg:
            raise self.error(
                "spin_deg", f"must be 0 when a contact spacing chooses the spin, got {self.spin_deg:g}"
            )


@dataclass(frozen=True)
class Tolerance(Table):
    """What the plan may miss by: the depth of a gouge, and the chord of a move against the true path."""

    table: ClassVar[str] = "tolerance"

    gouge_mm: float = key(positive("mm"), 0.001)
    chord_mm: float = key(positive("mm"), 0.01)


@dataclass(frozen=True)
class LinkSpec(Table):
    """How the tool gets from one cut to the next."""

    table: ClassVar[str] = "link"

    safe_clearance_mm: float = key(
        positive("mm"), 5.0
    )  # between the part and the whole tool on the safe plane
    approach_distance_mm: float = key(positive("mm"), 2.0)  # how near to the part a rapid may come


@dataclass(frozen=True)
class MachineSpec(Table):
    table: ClassVar[str] = "machine"

    name: str = key(values.text, DEFAULT_MACHINE)


@dataclass(frozen=True)
class PostSpec(Table):
    """The program's dialect, its name, and the feeds and speed in it."""

    table: ClassVar[str] = "post"

    name: str = key(values.text, DEFAULT_POST)
    program_name: str = key(values.text, "MPM01")
    tool_number: int = key(values.whole(1, 99999), 1)
    spindle_rpm: float = key(positive("turns per minute"), 8000.0)
    cut_feed_mm_per_min: float = key(positive("mm/min"), 1000.0)
    plunge_feed_mm_per_min: float = key(positive("mm/min"), 300.0)
    tcp: bool = key(values.flag, True)  # the control holds the tip; false: the program moves the joints
    options: dict[str, Any] = field(default_factory=dict, metadata={"check": values.options})


_TABLES: tuple[type[Table], ...] = (
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
