"""What every room stands on: names of arrays, errors, tables that check themselves, stages, files written whole.

It knows nothing of machining, and opens without the native module.
To add a kind of value: one check in `values.py`."""

from __future__ import annotations

from . import output, pages, values
from .arrays import Flags, Floats, Integers, Names
from .errors import Cancelled, InputError, blame, one_line
from .output import write_atomically, write_together
from .resources import EXAMPLES, FORMS, MACHINES, RESOURCES, TOOLS
from .stages import Cancel, Progress, Stages
from .tables import Key, Table, key, read_toml, suggestion
from .values import (
    Check,
    Vector,
    between,
    choice,
    flag,
    inside,
    not_negative,
    number,
    positive,
    text,
    vector,
    whole,
)

__all__ = [
    "Cancel",
    "Cancelled",
    "Check",
    "EXAMPLES",
    "FORMS",
    "Flags",
    "Floats",
    "InputError",
    "Integers",
    "Key",
    "MACHINES",
    "Names",
    "Progress",
    "RESOURCES",
    "Stages",
    "TOOLS",
    "Table",
    "Vector",
    "between",
    "blame",
    "choice",
    "flag",
    "inside",
    "key",
    "not_negative",
    "number",
    "one_line",
    "output",
    "pages",
    "positive",
    "read_toml",
    "suggestion",
    "text",
    "values",
    "vector",
    "whole",
    "write_atomically",
    "write_together",
]
