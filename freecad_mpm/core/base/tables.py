"""`Table`: a frozen dataclass that is one table of a TOML file and checks itself.

Every field is made with `key(check, default, words)`; values are checked whether they come from a file or from a script.
`Table.keys()` is what else follows from: pages, reports, FreeCAD's properties."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields
from pathlib import Path
from typing import Any, ClassVar, TypeVar

import tomllib

from .errors import InputError
from .values import Check

S = TypeVar("S", bound="Table")


# How names end by the unit of their values.
ENDINGS = {"mm": "_mm", "degrees": "_deg", "mm/min": "_mm_per_min", "turns per minute": "_rpm"}


def key(check: Check, default: Any = MISSING, words: str = "") -> Any:
    """A dataclass field whose value must pass `check`; without a default it must be given. words: what it is, for users,
    in one sentence without a full stop. A default that is a function is called for each new table."""
    metadata = {"check": check, "words": words}
    if callable(default):
        return field(default_factory=default, metadata=metadata)
    return field(default=default, metadata=metadata)


@dataclass(frozen=True)
class Key:
    """What is told of a key once."""

    table: str
    name: str
    default: Any  # MISSING: it must be given
    check: Check
    words: str

    @property
    def full_name(self) -> str:
        """table.name"""
        return f"{self.table}.{self.name}"

    @property
    def label(self) -> str:
        """The name as people say it, without its unit: side step."""
        return self.name.removesuffix(ENDINGS.get(self.check.unit, "")).replace("_", " ")


@dataclass(frozen=True)
class Table:
    """Base of the tables; `table` is the table's name, put in brackets before every message."""

    table: ClassVar[str]

    def __post_init__(self) -> None:
        for one in fields(self):
            try:
                value = one.metadata["check"](getattr(self, one.name))
            except ValueError as error:
                raise self.error(one.name, str(error)) from None
            object.__setattr__(self, one.name, value)
        self.check_together()

    @classmethod
    def keys(cls) -> tuple[Key, ...]:
        """The keys in their order."""
        return tuple(Key(cls.table, one.name, _default(one), **one.metadata) for one in fields(cls))

    def check_together(self) -> None:
        """Check what concerns several keys at once; raises `self.error(...)`."""

    @classmethod
    def error(cls, name: str, message: str) -> InputError:
        """To be raised: names the table and the key, but not the file, which whoever reads it puts in front."""
        return InputError(f"[{cls.table}] {name}: {message}")

    @classmethod
    def from_table(cls: type[S], table: Any) -> S:
        """Build from a TOML table; raises InputError for unknown, missing and wrong keys."""
        if not isinstance(table, Mapping):
            raise InputError(f"[{cls.table}]: must be a table, got {table!r}")
        names = [one.name for one in cls.keys()]
        for name in table:
            if name not in names:
                raise cls.error(name, f"unknown key{suggestion(name, names)}")
        for one in cls.keys():
            if one.default is MISSING and one.name not in table:
                raise cls.error(one.name, "is missing")
        return cls(**table)


def _default(one: Field[Any]) -> Any:
    return one.default if one.default_factory is MISSING else one.default_factory()


def suggestion(name: str, known: Iterable[str]) -> str:
    """`; did you mean …?` with the nearest known name, or the list of all when none is near."""
    known = list(known)
    near = difflib.get_close_matches(name, known, n=1)
    return f"; did you mean {near[0]}?" if near else f"; there are {', '.join(known)}"


def read_toml(path: str | Path) -> dict[str, Any]:
    """The tables of a TOML file; raises InputError naming the file when it is missing, unreadable or no TOML."""
    try:
        return tomllib.loads(Path(path).read_bytes().decode())
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: must be a TOML text in UTF-8") from None
    except tomllib.TOMLDecodeError as error:
        raise InputError(f"{path}: is not valid TOML: {error}") from None
