"""Cutters: `ToolSpec`, and the TOML files they come from (resources/tools)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from ..base import TOOLS, Check, InputError, Table, key, not_negative, positive, read_toml, values

# Flute length of a cutter that is described by its radii alone, in cutter radii.
DEFAULT_FLUTE_RADII = 4.0


@dataclass(frozen=True)
class Segment(Table):
    """A truncated cone of the shank or holder about the tool axis, standing on the one before it."""

    table: ClassVar[str] = "segment"

    bottom_radius_mm: float = key(positive("mm"), words="Radius at its lower end")
    top_radius_mm: float = key(positive("mm"), words="Radius at its upper end")
    length_mm: float = key(positive("mm"), words="Length along the tool axis")


def _segments(value: Any) -> tuple[Segment, ...] | None:
    """Given as such or as tables."""
    if not isinstance(value, Sequence) or isinstance(value, str):
        return None
    return tuple(one if isinstance(one, Segment) else Segment.from_table(one) for one in value)


SEGMENTS = Check(tuple, "a list of tables", _segments)


@dataclass(frozen=True)
class ToolSpec(Table):
    """A toroidal cutter."""

    table: ClassVar[str] = "tool"

    major_radius_mm: float = key(
        not_negative("mm"), words="Ro, of the circle on which the torus' centres lie; 0: a ball end"
    )
    minor_radius_mm: float = key(
        not_negative("mm"), words="Ri, of the torus, that is of the corner; 0: a flat end"
    )
    recess_mm: float = key(
        not_negative("mm"), 0.0, "Depth of the hollow in the cutter's bottom; 0: flat bottom"
    )
    flute_length_mm: float = key(
        not_negative("mm"),
        0.0,
        f"Length of the flutes from the tip; 0: {DEFAULT_FLUTE_RADII:g} times the cutter's radius",
    )
    shank: tuple[Segment, ...] = key(
        SEGMENTS, (), "Truncated cones that stand on the flutes, one upon the other"
    )
    holder: tuple[Segment, ...] = key(SEGMENTS, (), "Truncated cones that stand on the shank")
    name: str = key(values.any_text, "", "What lists and messages call it")

    def check_together(self) -> None:
        """Raises InputError for a shape that no torus cutter has; fills in the flute length, mm, where it is 0."""
        if self.radius_mm == 0:
            raise self.error("major_radius_mm", "must not be 0 when minor_radius_mm is 0 too")
        if self.recess_mm > self.minor_radius_mm:
            limit = f"at most minor_radius_mm ({self.minor_radius_mm:g})"
            raise self.error("recess_mm", f"must be {limit}, got {self.recess_mm!r}")
        if self.flute_length_mm == 0:
            object.__setattr__(self, "flute_length_mm", DEFAULT_FLUTE_RADII * self.radius_mm)
        if self.flute_length_mm <= self.minor_radius_mm:
            limit = f"more than minor_radius_mm ({self.minor_radius_mm:g})"
            raise self.error("flute_length_mm", f"must be {limit}, got {self.flute_length_mm!r}")

    @property
    def radius_mm(self) -> float:
        """Of the cutter: Ro + Ri."""
        return self.major_radius_mm + self.minor_radius_mm

    def describe(self) -> str:
        """One line for reports and lists."""
        shape = f"Ro {self.major_radius_mm:g} mm, Ri {self.minor_radius_mm:g} mm"
        bottom = f"recess {self.recess_mm:g} mm" if self.recess_mm else "flat bottom"
        return ", ".join(filter(None, (self.name, shape, bottom)))


def load(path: str | Path) -> ToolSpec:
    """The tool of a TOML file. Raises InputError naming the file and the key that is wrong."""
    table = read_toml(path)
    try:
        return ToolSpec.from_table(table)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def find(name: str, folder: Path) -> Path:
    """The file a job means by `name`: relative to the job's folder, else a shipped tool (with or without .toml)."""
    shipped = TOOLS / name
    candidates = (folder / name, shipped, shipped.with_name(shipped.name + ".toml"))
    return next((path for path in candidates if path.is_file()), folder / name)


def resolve(table: Mapping[str, Any], folder: Path) -> ToolSpec:
    """The tool of a job's [tool] table, which holds either the tool's keys or `file`."""
    if "file" not in table:
        return ToolSpec.from_table(table)
    others = [name for name in table if name != "file"]
    if others:
        raise ToolSpec.error("file", f"must be the only key, but {', '.join(others)} is there too")
    try:
        name = values.text(table["file"])
    except ValueError as error:
        raise ToolSpec.error("file", str(error)) from None
    return load(find(name, folder))
