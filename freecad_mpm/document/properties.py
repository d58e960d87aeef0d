"""The operation's properties in one table. Those that the user sets follow from the job's keys.

To add one: a line with `setting`; the key that it is of says type, group, words, default and choices."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from ..core.base import Check
from ..core.job import KEYS

# Raised when the meaning of a stored property changes; `migrate` then turns older documents into the new form.
SCHEMA_VERSION = 1

READ_ONLY, HIDDEN = 1, 2

Choices = Callable[[], Sequence[str]]

# Table of the job -> group in the property editor.
GROUPS = {
    "method": "Method",
    "footprint": "Footprint",
    "link": "Links",
    "tool": "Cutter",
    "tolerance": "Tolerance",
    "machine": "Program",
    "post": "Program",
}


@dataclass(frozen=True)
class Property:
    """A row of the table: how FreeCAD makes, shows and first fills one property."""

    name: str
    type: str  # FreeCAD's, without "App::Property"
    group: str
    doc: str
    default: Any = None
    choices: Choices | None = None
    mode: int = 0
    key: str = ""  # of the job, where it is the user's to set


def setting(name: str, full_name: str, choices: Choices | None = None) -> Property:
    """The property of a key of the job. choices: names that only the core knows."""
    key = KEYS[full_name]
    known = choices or ((lambda: key.check.choices) if key.check.choices else None)
    kind = "Enumeration" if known else type_of(key.check)
    return Property(name, kind, GROUPS[key.table], key.words, key.default, known, key=full_name)


def type_of(check: Check) -> str:
    """FreeCAD's type for values that pass the check; its lengths are not negative, its distances may be."""
    if check.kind is bool:
        return "Bool"
    if check.unit == "degrees":
        return "Angle"
    if check.unit == "mm":
        return "Length" if check.low >= 0 else "Distance"
    raise ValueError(f"FreeCAD has no type here for {check.what}")


# The choices come from the core, imported only when a property is made: a document must open without the native module.
def _methods() -> list[str]:
    from ..core.positioning import method_names

    return method_names()


def _machines() -> list[str]:
    from ..core import machine

    return machine.names()


def _posts() -> list[str]:
    from ..core import posts

    return posts.names()


PROPERTIES = (
    setting("Method", "method.name", _methods),
    setting("Spin", "method.spin_deg"),
    setting("ContactSpacing", "method.contact_spacing_mm"),
    setting("SpacingMeasure", "method.spacing_measure"),
    setting("TiltMax", "method.tilt_max_deg"),
    setting("Direction", "footprint.direction_deg"),
    setting("SideStep", "footprint.side_step_mm"),
    setting("ForwardStep", "footprint.forward_step_mm"),
    setting("ZigZag", "footprint.zigzag"),
    setting("Margin", "footprint.margin_mm"),
    setting("AllowGaps", "footprint.allow_gaps"),
    setting("SafeClearance", "link.safe_clearance_mm"),
    setting("ApproachDistance", "link.approach_distance_mm"),
    setting("Recess", "tool.recess_mm"),
    setting("GougeTolerance", "tolerance.gouge_mm"),
    setting("ChordTolerance", "tolerance.chord_mm"),
    setting("Machine", "machine.name", _machines),
    setting("Post", "post.name", _posts),
    Property("Verdict", "String", "Result", "Whether the plan is good, in one line", "", mode=READ_ONLY),
    Property(
        "Good",
        "Bool",
        "Result",
        "The plan has no gouge, nothing undecided, no cut left out and no limit exceeded",
        False,
        mode=READ_ONLY,
    ),  # fmt: skip
    Property("Positions", "Integer", "Result", "Number of tool positions", 0, mode=READ_ONLY),
    Property(
        "WorstClearance",
        "Distance",
        "Result",
        "Smallest distance found from the cutter to a face; negative: gouge",
        0.0,
        mode=READ_ONLY,
    ),  # fmt: skip
    Property("Statuses", "StringList", "Result", "How many positions have each status", [], mode=READ_ONLY),
    Property("Report", "String", "Result", "The plan in words", "", mode=READ_ONLY),
    Property(
        "Problem", "String", "Result", "Why there is no up-to-date path; empty: there is", "", mode=READ_ONLY
    ),
    Property(
        "MoveStatus",
        "IntegerList",
        "Stored",
        "Status of each move as an index into StatusNames; -1: none",
        [],
        mode=HIDDEN,
    ),  # fmt: skip
    Property(
        "PositionClearance",
        "FloatList",
        "Stored",
        "Least distance from the cutter to a face at each position of the path, mm",
        [],
        mode=HIDDEN,
    ),  # fmt: skip
    Property("StatusNames", "StringList", "Stored", "The names MoveStatus refers to", [], mode=HIDDEN),
    Property(
        "FirstContacts",
        "VectorList",
        "Stored",
        "Where the cutter touches the faces first (P)",
        [],
        mode=HIDDEN,
    ),
    Property("SecondContacts", "VectorList", "Stored", "Where it touches them at once (Q)", [], mode=HIDDEN),
    Property(
        "SchemaVersion", "Integer", "Stored", "Version of these properties", SCHEMA_VERSION, mode=HIDDEN
    ),
)


def settings() -> list[Property]:
    """The properties that are the user's to set."""
    return [one for one in PROPERTIES if one.key]


def add_missing(obj: Any) -> None:
    """Give the operation the properties it lacks: all to a new one, the later ones to one from an older document."""
    for one in PROPERTIES:
        if not hasattr(obj, one.name):
            obj.addProperty(f"App::Property{one.type}", one.name, one.group, one.doc)
            _set_default(obj, one)
        if one.mode:  # not kept in documents
            obj.setEditorMode(one.name, one.mode)


def _set_default(obj: Any, one: Property) -> None:
    if one.choices is not None:
        setattr(obj, one.name, list(one.choices()))
    setattr(obj, one.name, one.default)
