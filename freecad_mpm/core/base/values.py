"""What the values of a job may be: one small `Check` a kind of value.

A check takes the value as TOML or a script gives it and returns it in its own type, or raises ValueError with what
would be right and what was given; whoever knows the file and the key puts them in front. It can be read, too: kind,
unit, range and choices are what pages and FreeCAD's properties follow from."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

Vector = tuple[float, float, float]

# Sine of the angle under which two directions count as parallel: a set-up frame from them would be mostly rounding.
PARALLEL = 1e-9


@dataclass(frozen=True)
class Check:
    """What a value may be; called with one, it gives it in its own type or raises ValueError."""

    kind: type
    what: str  # would be right
    take: Callable[[Any], Any]  # the value in its own type; None: it is not right
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    choices: tuple[str, ...] = ()

    def __call__(self, value: Any) -> Any:
        taken = self.take(value)
        if taken is None:
            raise ValueError(f"must be {self.what}, got {value!r}")
        return taken


def positive(unit: str) -> Check:
    """More than 0 and finite; gives a float."""
    return _number(f"a positive number of {unit}", unit, 0.0, ends=False)


def not_negative(unit: str) -> Check:
    """0 or more and finite; gives a float."""
    return _number(f"zero or a positive number of {unit}", unit, 0.0)


def number(unit: str) -> Check:
    """Of either sign, finite; gives a float."""
    return _number(f"a finite number of {unit}", unit)


def between(lo: float, hi: float, unit: str) -> Check:
    """lo <= value <= hi; gives a float."""
    return _number(f"a number of {unit} from {lo:g} to {hi:g}", unit, lo, hi)


def inside(lo: float, hi: float, unit: str) -> Check:
    """lo < value < hi; gives a float."""
    return _number(f"a number of {unit} more than {lo:g} and less than {hi:g}", unit, lo, hi, ends=False)


def whole(lo: int, hi: int) -> Check:
    """lo <= value <= hi; neither 2.0 nor true is a whole number."""

    def take(value: Any) -> int | None:
        fits = isinstance(value, int) and not isinstance(value, bool) and lo <= value <= hi
        return value if fits else None

    return Check(int, f"a whole number from {lo} to {hi}", take, low=lo, high=hi)


def choice(*names: str) -> Check:
    """One of the names, written exactly like it."""
    what = " or ".join(f'"{name}"' for name in names)
    return Check(str, what, lambda value: value if value in names else None, choices=names)


def named(what: str) -> Check:
    """A text that is not empty, and what it names."""
    return Check(str, what, lambda value: value if isinstance(value, str) and value.strip() else None)


def are_parallel(a: Vector, b: Vector) -> bool:
    """Whether two directions (or their opposites) are the same up to PARALLEL."""
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return math.hypot(*cross) <= PARALLEL * math.hypot(*a) * math.hypot(*b)


def _number(what: str, unit: str, low: float = -math.inf, high: float = math.inf, ends: bool = True) -> Check:
    """A finite number from `low` to `high`, both included or (`ends`) not."""

    def take(value: Any) -> float | None:
        fits = _finite(value) and (low <= value <= high if ends else low < value < high)
        return float(value) if fits else None

    return Check(float, what, take, unit, low, high)


def _finite(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _texts(value: Any) -> tuple[str, ...] | None:
    fits = _is_list(value) and all(isinstance(one, str) for one in value)
    return tuple(value) if fits else None


def _vector(value: Any) -> Vector | None:
    if _is_list(value) and len(value) == 3 and all(map(_finite, value)):
        x, y, z = (float(one) for one in value)
        return x, y, z
    return None


def _direction(value: Any) -> Vector | None:
    taken: Vector = vector(value)
    return taken if math.hypot(*taken) > 0 else None


def _is_list(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


text = named("a text that is not empty")
any_text = Check(str, "a text", lambda value: value if isinstance(value, str) else None)
path = Check(
    str,
    "the name of a file",
    lambda value: os.fspath(value) if isinstance(value, (str, os.PathLike)) else None,
)
texts = Check(tuple, 'a list of names such as ["Face1"]', _texts)
flag = Check(bool, "true or false", lambda value: value if isinstance(value, bool) else None)
options = Check(dict, "a table of options", lambda value: dict(value) if isinstance(value, Mapping) else None)
vector = Check(tuple, "three finite numbers", _vector)
direction = Check(tuple, "a direction that is not of length zero", _direction)
