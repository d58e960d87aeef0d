"""The operation's properties and tool controller as the core's `Job`."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from ..core import job
from ..core.base import InputError
from ..core.job import Segment
from . import compat

# The job's part comes from the document, not from a file; the name is what messages and reports show.
PART_NAME = "{document}: {operation}"
# The core's keys -> the properties they come from.
PROPERTY_OF = {
    "[method] name": "Method",
    "[method] spin_deg": "Spin",
    "[method] contact_spacing_mm": "ContactSpacing",
    "[method] tilt_max_deg": "TiltMax",
    "[footprint] direction_deg": "Direction",
    "[footprint] side_step_mm": "SideStep",
    "[footprint] forward_step_mm": "ForwardStep",
    "[footprint] steps": "SideStep, ForwardStep",
    "[footprint] margin_mm": "Margin",
    "[link] safe_clearance_mm": "SafeClearance",
    "[link] approach_distance_mm": "ApproachDistance",
    "[tool] recess_mm": "Recess",
    "[tool] flute_length_mm": "the tool's CuttingEdgeHeight",
    "[tolerance] gouge_mm": "GougeTolerance",
    "[tolerance] chord_mm": "ChordTolerance",
}
SECONDS_PER_MINUTE = 60.0
PROGRAM_NAME = "MPM{number:02d}"


def job_of(op: Any, machined: Sequence[str], check: Sequence[str]) -> job.Job:
    """The job of operation `op` with the names of the faces to machine and to keep clear of.

    The set-up frame is FreeCAD's global frame, as in all of CAM. Raises InputError naming the property or the tool.
    """
    name = PART_NAME.format(document=op.Document.Label, operation=op.Label)
    return job.Job(
        part=job.Part(file=name, faces=tuple(machined), check_faces=tuple(check)),
        tool=tool_of(op),
        footprint=_footprint(op),
        method=job.MethodSpec(
            name=op.Method,
            spin_deg=op.Spin.Value,
            contact_spacing_mm=op.ContactSpacing.Value,
            spacing_measure=op.SpacingMeasure,
            tilt_max_deg=op.TiltMax.Value,
        ),
        link=job.LinkSpec(
            safe_clearance_mm=op.SafeClearance.Value, approach_distance_mm=op.ApproachDistance.Value
        ),
        tolerance=job.Tolerance(gouge_mm=op.GougeTolerance.Value, chord_mm=op.ChordTolerance.Value),
        machine=job.MachineSpec(name=op.Machine),
        post=post_of(op),
        source=op.Label,
    )


def tool_of(op: Any) -> job.ToolSpec:
    """The cutter of the operation's tool controller."""
    bit = op.ToolController.Tool
    try:
        radius, corner = compat.torus_of(bit)
    except ValueError as error:
        raise InputError(str(error)) from None
    return job.ToolSpec(
        major_radius_mm=radius - corner,
        minor_radius_mm=corner,
        recess_mm=op.Recess.Value,
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
    return job.PostSpec(
        name=op.Post,
        program_name=PROGRAM_NAME.format(number=_number_in(op.Name)),
        tool_number=controller.ToolNumber,
        **{name: value for name, value in given.items() if value > 0},
    )


def in_property_names(message: str, op: Any) -> str:
    """A message of the core about operation `op` with the properties' names instead of its own keys."""
    message = message.removeprefix(f"{op.Label}: ")  # the source of its job
    for key, name in PROPERTY_OF.items():
        message = message.replace(key, name)
    return message


def _footprint(op: Any) -> job.FootprintSpec:
    return job.FootprintSpec(
        direction_deg=op.Direction.Value,
        side_step_mm=op.SideStep.Value,
        forward_step_mm=op.ForwardStep.Value,
        zigzag=op.ZigZag,
        margin_mm=op.Margin.Value,
        allow_gaps=op.AllowGaps,
    )


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
