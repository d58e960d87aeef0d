"""The operation's properties: one table with type, group, default and the words the property editor shows."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..core.job import ACROSS, DEFAULT_MACHINE, DEFAULT_METHOD, DEFAULT_POST, DIRECT

# Raised when the meaning of a stored property changes; `migrate` then turns older documents into the new form.
SCHEMA_VERSION = 1

READ_ONLY, HIDDEN = 1, 2


@dataclass(frozen=True)
class Property:
    name: str
    type: str  # FreeCAD's, without "App::Property"
    group: str
    doc: str
    default: Any = None
    choices: Callable[[], list[str]] | None = None
    mode: int = 0


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
    Property("Method", "Enumeration", "Method", "How each tool position is found", DEFAULT_METHOD, _methods),
    Property(
        "Spin",
        "Angle",
        "Method",
        "Turn of the tilt direction about the vertical, from the feed direction",
        0.0,
    ),
    Property(
        "ContactSpacing",
        "Length",
        "Method",
        "Distance of the two contacts, kept along the passes by the spin of each position; 0: Spin is the same for all",
        0.0,
    ),
    Property(
        "SpacingMeasure",
        "Enumeration",
        "Method",
        "How the distance of the contacts is measured: across the feed, or direct from one to the other",
        ACROSS,
        lambda: [ACROSS, DIRECT],
    ),
    Property("TiltMax", "Angle", "Method", "Largest angle between the tool axis and the vertical", 45.0),
    Property("Direction", "Angle", "Footprint", "Feed direction in the XY plane, from the X axis", 90.0),
    Property("SideStep", "Length", "Footprint", "Distance between neighbouring passes, seen from above", 5.0),
    Property(
        "ForwardStep", "Length", "Footprint", "Distance between positions along a pass, seen from above", 2.0
    ),
    Property("ZigZag", "Bool", "Footprint", "Cut every second pass in the opposite direction", False),
    Property(
        "Margin", "Distance", "Footprint", "Distance kept from the outline of the faces, seen from above", 0.0
    ),
    Property(
        "AllowGaps",
        "Bool",
        "Footprint",
        "The plan is good although it leaves out cuts between neighbouring positions",
        False,
    ),
    Property(
        "SafeClearance", "Length", "Links", "Between the part and the whole tool on the safe plane", 5.0
    ),
    Property("ApproachDistance", "Length", "Links", "How near to the part a rapid may come", 2.0),
    Property("Recess", "Length", "Cutter", "Depth of the hollow in the cutter's bottom; 0: flat bottom", 0.0),
    Property("GougeTolerance", "Length", "Tolerance", "Depth by which the cutter may enter a face", 0.001),
    Property(
        "ChordTolerance",
        "Length",
        "Tolerance",
        "Distance between the true path and the straight moves of machine and model",
        0.01,
    ),
    Property(
        "Machine",
        "Enumeration",
        "Program",
        "The machine the joint values are computed for",
        DEFAULT_MACHINE,
        _machines,
    ),
    Property("Post", "Enumeration", "Program", "The form of the program text", DEFAULT_POST, _posts),
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
    return [one for one in PROPERTIES if not one.mode]


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
        setattr(obj, one.name, one.choices())
    setattr(obj, one.name, one.default)
