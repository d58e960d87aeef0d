"""The job: everything that a plan depends on, as dataclasses and as a TOML file (docs/job-file.md)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, ClassVar

from ..base import (
    InputError,
    Table,
    Vector,
    between,
    choice,
    inside,
    key,
    not_negative,
    one_line,
    positive,
    values,
)
from .tool import ToolSpec

# Names given when the job names none.
DEFAULT_METHOD = "exact"
DEFAULT_MACHINE = "dmu80p"
DEFAULT_POST = "dmu80p"

# Ways to measure the distance of two contacts: seen along the feed, or from one to the other.
ACROSS, DIRECT = "across", "direct"


@dataclass(frozen=True)
class Part(Table):
    """Which faces."""

    table: ClassVar[str] = "part"

    file: str = key(values.path, words="The part: STEP, IGES, BREP, or Bézier patches as text (.txt)")
    faces: tuple[str, ...] = key(values.texts, (), "The faces to machine; none named: all")
    check_faces: tuple[str, ...] = key(values.texts, (), "The faces to keep clear of; none named: all others")


@dataclass(frozen=True)
class Setup(Table):
    """The set-up frame in the part's frame."""

    table: ClassVar[str] = "setup"

    origin: Vector = key(values.vector, (0.0, 0.0, 0.0), "Its origin, mm")
    z: Vector = key(values.direction, (0.0, 0.0, 1.0), "Its z axis, towards the spindle")
    x: Vector = key(
        values.direction, (1.0, 0.0, 0.0), "Its x axis, turned into the plane across z; not parallel to z"
    )

    def check_together(self) -> None:
        """Raises InputError when x and z span no plane."""
        if values.are_parallel(self.x, self.z):
            raise self.error("x", f"must not be parallel to z {list(self.z)}, got {list(self.x)}")


@dataclass(frozen=True)
class FootprintSpec(Table):
    """Where in plan the tool is to stand."""

    table: ClassVar[str] = "footprint"

    pattern: str = key(choice("raster"), "raster", "How the positions lie in plan: in straight passes")
    direction_deg: float = key(
        values.number("degrees"),
        90.0,
        "Feed direction seen from above, from the x axis; the side step goes to its right",
    )
    # Nobody knows the faces beforehand: a fifth of the shipped cutter's diameter is fine without being slow.
    side_step_mm: float = key(positive("mm"), 5.0, "Distance between neighbouring passes, seen from above")
    forward_step_mm: float = key(
        positive("mm"), 2.0, "Distance between positions along a pass, seen from above"
    )
    zigzag: bool = key(values.flag, False, "Cut every second pass in the opposite direction")
    margin_mm: float = key(
        values.number("mm"),
        0.0,
        "How far the passes reach beyond the faces, seen from above; negative: inside the rectangle round them",
    )
    allow_gaps: bool = key(
        values.flag, False, "The plan is good although it leaves out cuts between neighbouring positions"
    )


@dataclass(frozen=True)
class MethodSpec(Table):
    """How the tool is placed."""

    table: ClassVar[str] = "method"

    name: str = key(values.named("the name of a method"), DEFAULT_METHOD, "How each tool position is found")
    spin_deg: float = key(
        between(-180, 180, "degrees"),
        0.0,
        "Turn of the tool about the normal at its first contact, before it tilts; 0 where the method cannot spin",
    )
    contact_spacing_mm: float = key(
        not_negative("mm"),
        0.0,
        "Distance of the two contacts, kept along the passes by the spin of each position; 0: one spin for all",
    )
    spacing_measure: str = key(
        choice(ACROSS, DIRECT),
        ACROSS,
        "How the distance of the contacts is measured: across the feed, or direct from one to the other",
    )
    tilt_max_deg: float = key(
        inside(0, 90, "degrees"),
        45.0,
        "Largest tilt; without a spin that is the angle between the tool axis and the vertical",
    )
    options: dict[str, Any] = key(values.options, dict, "Numbers of the method's own")

    def check_together(self) -> None:
        """Raises InputError when two keys both decide the spin."""
        if self.contact_spacing_mm and self.spin_deg:
            raise self.error(
                "spin_deg", f"must be 0 when a contact spacing chooses the spin, got {self.spin_deg:g}"
            )


@dataclass(frozen=True)
class Tolerance(Table):
    """What the plan may miss by."""

    table: ClassVar[str] = "tolerance"

    gouge_mm: float = key(positive("mm"), 0.001, "Depth by which the cutter may enter a face at a position")
    chord_mm: float = key(
        positive("mm"), 0.01, "Distance between the true path and the straight moves of machine and model"
    )


@dataclass(frozen=True)
class LinkSpec(Table):
    """How the tool gets from one cut to the next."""

    table: ClassVar[str] = "link"

    safe_clearance_mm: float = key(
        positive("mm"), 5.0, "Between the part and the whole tool on the safe plane"
    )
    approach_distance_mm: float = key(positive("mm"), 2.0, "How near to the part a rapid may come")


@dataclass(frozen=True)
class MachineSpec(Table):
    """What makes the moves."""

    table: ClassVar[str] = "machine"

    name: str = key(
        values.named("a shipped machine or its file"),
        DEFAULT_MACHINE,
        "The machine the joint values are computed for",
    )


@dataclass(frozen=True)
class PostSpec(Table):
    """The program."""

    table: ClassVar[str] = "post"

    name: str = key(values.named("the name of a post"), DEFAULT_POST, "The form of the program text")
    program_name: str = key(
        values.text, "MPM01", "The program's name: 1 to 16 capital letters, digits and underscores"
    )
    tool_number: int = key(values.whole(1, 99999), 1, "The tool's number in the control")
    spindle_rpm: float = key(positive("turns per minute"), 8000.0, "Speed of the spindle")
    cut_feed_mm_per_min: float = key(positive("mm/min"), 1000.0, "Feed of the cuts")
    plunge_feed_mm_per_min: float = key(positive("mm/min"), 300.0, "Feed of the plunges")
    tcp: bool = key(values.flag, True, "The control holds the tip; false: the program moves the joints")
    options: dict[str, Any] = key(values.options, dict, "What the post may be asked for besides")


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
# Every key of a job by its full name, e.g. "footprint.side_step_mm".
KEYS = {one.full_name: one for table in _TABLES for one in table.keys()}


@dataclass(frozen=True)
class Job:
    """All that a plan depends on, checked; two are equal wherever they came from."""

    part: Part
    tool: ToolSpec
    setup: Setup = Setup()
    footprint: FootprintSpec = FootprintSpec()
    method: MethodSpec = MethodSpec()
    tolerance: Tolerance = Tolerance()
    link: LinkSpec = LinkSpec()
    machine: MachineSpec = MachineSpec()
    post: PostSpec = PostSpec()
    label: str = field(default="job", compare=False)  # put in front of messages: its file, or its operation

    def error(self, table: str, name: str, message: str) -> InputError:
        """To be raised: names the job's label, the table and the key."""
        return InputError(f"{self.label}: [{table}] {name}: {message}")

    @contextmanager
    def blamed(self, table: str) -> Iterator[None]:
        """Make a ValueError of the block, which begins with an argument's name, an InputError with label and table: that
        which alone has a key of this name (a method may object to the tool), else `table`."""
        try:
            yield
        except ValueError as error:
            name = str(error).partition(":")[0]
            owners = [key.table for key in KEYS.values() if key.name == name]
            home = owners[0] if len(owners) == 1 else table
            raise InputError(f"{self.label}: [{home}] {one_line(error)}") from None
