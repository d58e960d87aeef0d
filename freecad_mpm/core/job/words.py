"""The keys in words: tables for docs/job-file.md, and what a job asks for as lines of a report."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING
from typing import Any

from ..base import Key, Table
from .file import to_toml
from .tables import SECTIONS
from .tool import Segment

YES_NO = {True: "yes", False: "no"}
# The names of the tables stand in a column of their own.
NAME_WIDTH = 11


def page_tables() -> str:
    """A table of keys for every table of a job file, in Markdown."""
    return "\n\n".join(_page_table(one) for one in (*SECTIONS.values(), Segment))


def _page_table(table: type[Table]) -> str:
    rows = ["| key | what | must be | default |", "|---|---|---|---|", *map(_page_row, table.keys())]
    return "\n".join([f"### {table.table}", "", str(table.__doc__), "", *rows])


def _page_row(key: Key) -> str:
    default = "–" if key.default is MISSING else f"`{to_toml(key.default)}`"
    return f"| `{key.name}` | {key.words} | {key.check.what} | {default} |"


def job_lines(tables: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """One line a table: what it asks for, empty values left out. tables: of a job, as plain values."""
    return [_line(section, tables[name]) for name, section in SECTIONS.items()]


def _line(section: type[Table], values: Mapping[str, Any]) -> str:
    said = [
        f"{key.label} {_said(values[key.name])} {key.check.unit}".strip() for key in _told(section, values)
    ]
    return f"{section.table.capitalize() + ':':{NAME_WIDTH}}{', '.join(said)}"


def _told(section: type[Table], values: Mapping[str, Any]) -> list[Key]:
    return [key for key in section.keys() if values[key.name] not in ("", (), [], {})]


def _said(value: Any) -> str:
    if isinstance(value, Mapping):
        return "(" + ", ".join(f"{name} {_said(one)}" for name, one in value.items()) + ")"
    if isinstance(value, (list, tuple)):
        return " ".join(map(_said, value))
    if isinstance(value, bool):
        return YES_NO[value]
    return f"{value:g}" if isinstance(value, float) else str(value)
