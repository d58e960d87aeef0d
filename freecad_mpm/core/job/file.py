"""A job as a TOML file (docs/job-file.md)."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

from ..base import InputError, Table, read_toml, suggestion
from . import tool
from .tables import SECTIONS, Job, Part


def load(path: str | Path) -> Job:
    """The job of a TOML file; relative paths in it start at its folder.

    Raises InputError that names the file and the key, says what is wrong and what would be right."""
    path = Path(path)
    tables = read_toml(path)
    try:
        return replace(from_tables(tables, path.parent), label=str(path))
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
        tool=tool.resolve(tables["tool"], folder),
        **sections,
    )


def dump(job: Job) -> str:
    """The job as TOML, every key written out; `load` of it gives an equal job."""
    return "\n".join(_table(getattr(job, name)) for name in SECTIONS)


def _table(section: Table) -> str:
    lines = [f"{one.name} = {to_toml(getattr(section, one.name))}" for one in fields(section)]
    return "\n".join([f"[{section.table}]", *lines, ""])


def to_toml(value: Any) -> str:
    """A value as it is written behind its key."""
    if isinstance(value, Table):
        value = {one.name: getattr(value, one.name) for one in fields(value)}
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{to_toml(str(name))} = {to_toml(one)}" for name, one in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(to_toml, value)) + "]"
    # JSON's strings, numbers and booleans are TOML's too; DEL alone must be escaped in TOML.
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
