"""The operation's properties and tool controller as the core's `Job`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ..core import job
from ..core.base import InputError
from ..core.job import KEYS, Segment
from . import compat
from .properties import settings

# The job's part comes from the document, not from a file; the name is what messages and reports show.
PART_NAME = "{document}: {operation}"
SECONDS_PER_MINUTE = 60.0
PROGRAM_NAME = "MPM{number:02d}"


def job_of(op: Any, machined: Sequence[str], check: Sequence[str]) -> job.Job:
    """The job of operation `op` with the names of the faces to machine and to keep clear of.

    The set-up frame is FreeCAD's global frame, as in all of CAM. Raises InputError naming the property or the tool.
    """
    name = PART_NAME.format(document=op.Document.Label, operation=op.Label)
    made: dict[str, Any] = {
        "part": job.Part(file=name, faces=tuple(machined), check_faces=tuple(check)),
        "tool": tool_of(op),
        "post": post_of(op),
    }
    others: dict[str, Any] = {table: _table(op, table) for table in job.SECTIONS if table not in made}
    return job.Job(**made, **others, label=op.Label)


def tool_of(op: Any) -> job.ToolSpec:
    """The cutter of the operation's tool controller."""
    bit = op.ToolController.Tool
    try:
        radius, corner = compat.torus_of(bit)
    except ValueError as error:
        raise InputError(str(error)) from None
    return _table(
        op,
        job.ToolSpec.table,
        major_radius_mm=radius - corner,
        minor_radius_mm=corner,
        flute_length_mm=_length(bit, "CuttingEdgeHeight"),
        shank=_shank(bit),
        name=bit.Label,
    )


def post_of(op: Any) -> job.PostSpec:
    """Post, feeds, speed, tool number; a feed or speed that the controller leaves at zero has the core's default."""
    controller = op.ToolController
    given = {
        "spindle_rpm": float(controller.SpindleSpeed),
        "cut_feed_mm_per_min": controller.HorizFeed.Value * SECONDS_PER_MINUTE,
        "plunge_feed_mm_per_min": controller.VertFeed.Value * SECONDS_PER_MINUTE,
    }
    return _table(
        op,
        job.PostSpec.table,
        program_name=PROGRAM_NAME.format(number=_number_in(op.Name)),
        tool_number=controller.ToolNumber,
        **{name: value for name, value in given.items() if value > 0},
    )


def _table(op: Any, table: str, **others: Any) -> Any:
    """A table of the job from the operation's properties, and what comes from elsewhere."""
    own = [(KEYS[one.key], one.name) for one in settings()]
    values = {key.name: plain(getattr(op, name)) for key, name in own if key.table == table}
    return job.SECTIONS[table](**values, **others)


def plain(value: Any) -> Any:
    """A property's value as the core takes it: a quantity as its number of mm or degrees."""
    return value.Value if hasattr(value, "Value") else value


def _shank(bit: Any) -> tuple[Segment, ...]:
    """The cylinder above the flutes; CAM's tools have no holder."""
    radius, length = _length(bit, "ShankDiameter") / 2, _length(bit, "Length") - _length(
        bit, "CuttingEdgeHeight"
    )
    return (Segment(radius, radius, length),) if radius > 0 and length > 0 else ()


def _length(bit: Any, name: str) -> float:
    """A length of the tool bit in mm, 0 when its shape has no such parameter."""
    return float(getattr(bit, name).Value) if hasattr(bit, name) else 0.0


def _number_in(name: str) -> int:
    """The digits FreeCAD appends to tell objects apart, plus one: MultiPointFinish -> 1, MultiPointFinish001 -> 2."""
    digits = re.search(r"\d+$", name)
    return int(digits[0]) + 1 if digits else 1
