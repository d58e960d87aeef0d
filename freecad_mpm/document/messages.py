"""Messages of the core in FreeCAD's words: every key of the job as the property, or whatever else, it comes from."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from ..core.base import InputError
from ..core.job import KEYS
from . import properties

# The keys of the job that are no properties of the operation, and where they come from.
ELSEWHERE = {
    "part.file": "the document",
    "part.faces": "Base Geometry",
    "part.check_faces": "the model's other faces",
    "setup.origin": "FreeCAD's global origin",
    "setup.z": "FreeCAD's global z axis",
    "setup.x": "FreeCAD's global x axis",
    "tool.major_radius_mm": "the tool's FlatRadius (Diameter / 2 less CornerRadius)",
    "tool.minor_radius_mm": "the tool's CornerRadius (Diameter / 2 less FlatRadius)",
    "tool.flute_length_mm": "the tool's CuttingEdgeHeight",
    "tool.shank": "the tool's ShankDiameter and Length",
    "tool.holder": "the tool's holder, which CAM's tools do not have",
    "tool.name": "the tool's Label",
    "footprint.pattern": "the footprint's pattern, of which there is one",
    "method.options": "the method's own options, which keep their defaults",
    "post.program_name": "the operation's name",
    "post.tool_number": "the tool controller's ToolNumber",
    "post.spindle_rpm": "the tool controller's SpindleSpeed",
    "post.cut_feed_mm_per_min": "the tool controller's HorizFeed",
    "post.plunge_feed_mm_per_min": "the tool controller's VertFeed",
    "post.tcp": "the Job's Arguments (--no-tcp)",
    "post.options": "the Job's Arguments",
}
NAMES = ELSEWHERE | {one.key: one.name for one in properties.settings()}
# A key inside a sentence stands without its table: those that cannot be other words.
ALONE = {one.name: name for full_name, name in NAMES.items() if "_" in (one := KEYS[full_name]).name}
KEY = re.compile(r"\[([\w.]+)\] (\w+(?:\.\w+)*)|\b[a-z]+(?:_[a-z]+)+\b")


def in_property_names(message: str) -> str:
    """A message of the core with FreeCAD's names instead of the job's keys."""
    return KEY.sub(_name, message)


def _name(found: re.Match[str]) -> str:
    if not found[1]:
        return ALONE.get(found[0], found[0])
    full_name = f"{found[1]}.{found[2]}"
    whole, _, option = full_name.rpartition(".")
    if full_name not in NAMES and whole in NAMES:
        return f"{NAMES[whole]}: {option}"
    return NAMES.get(full_name, ALONE.get(found[2], found[0]))


@contextmanager
def property_names() -> Iterator[None]:
    """The block's InputErrors say FreeCAD's names."""
    try:
        yield
    except InputError as error:
        error.args = (in_property_names(str(error)),)
        raise
