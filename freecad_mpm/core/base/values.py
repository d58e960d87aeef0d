"""What the values of a job may be: one small check a kind of value.

A check takes the value as TOML or a script gives it and returns it in its own type, or raises ValueError with what
would be right and what was given; whoever knows the file and the key puts them in front."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NoReturn

Check = Callable[[Any], Any]
Vector = tuple[float, float, float]

# Sine of the angle under which two directions count as parallel: a set-up frame from them would be mostly rounding.
PARALLEL = 1e-9


def positive(unit: str) -> Check:
    return lambda value: _number(value, lambda x: x > 0, f"a positive number of {unit}")


def not_negative(unit: str) -> Check:
    return lambda value: _number(value, lambda x: x >= 0, f"zero or a positive number of {unit}")


def number(unit: str) -> Check:
    return lambda value: _number(value, lambda x: True, f"a finite number of {unit}")


def between(lo: float, hi: float, unit: str) -> Check:
    return lambda value: _number(value, lambda x: lo <= x <= hi, f"a number of {unit} from {lo:g} to {hi:g}")


def inside(lo: float, hi: float, unit: str) -> Check:
    what = f"a number of {unit} more than {lo:g} and less than {hi:g}"
    return lambda value: _number(value, lambda x: lo < x < hi, what)


def whole(lo: int, hi: int) -> Check:
    def check(value: Any) -> int:
        if isinstance(value, int) and not isinstance(value, bool) and lo <= value <= hi:
            return value
        _refuse(f"a whole number from {lo} to {hi}", value)

    return check


def choice(*names: str) -> Check:
    def check(value: Any) -> str:
        return value if value in names else _refuse(" or ".join(f'"{name}"' for name in names), value)

    return check


def text(value: Any) -> str:
    return value if isinstance(value, str) and value.strip() else _refuse("a text that is not empty", value)


def any_text(value: Any) -> str:
    return value if isinstance(value, str) else _refuse("a text", value)


def path(value: Any) -> str:
    return os.fspath(value) if isinstance(value, (str, os.PathLike)) else _refuse("the name of a file", value)


def texts(value: Any) -> tuple[str, ...]:
    if (
        isinstance(value, Sequence)
        and not isinstance(value, str)
        and all(isinstance(one, str) for one in value)
    ):
        return tuple(value)
    _refuse('a list of names such as ["Face1"]', value)


def flag(value: Any) -> bool:
    return value if isinstance(value, bool) else _refuse("true or false", value)


def options(value: Any) -> dict[str, Any]:
    return dict(value) if isinstance(value, Mapping) else _refuse("a table of options", value)


def vector(value: Any) -> Vector:
    if (
        isinstance(value, Sequence)
        and not isinstance(value, str)
        and len(value) == 3
        and all(map(_finite, value))
    ):
        x, y, z = (float(one) for one in value)
        return x, y, z
    _refuse("three finite numbers", value)


def direction(value: Any) -> Vector:
    result = vector(value)
    return result if math.hypot(*result) > 0 else _refuse("a direction that is not of length zero", value)


def are_parallel(a: Vector, b: Vector) -> bool:
    """Whether two directions (or their opposites) are the same up to PARALLEL."""
    cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    return math.hypot(*cross) <= PARALLEL * math.hypot(*a) * math.hypot(*b)


def _finite(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _number(value: Any, fits: Callable[[float], bool], what: str) -> float:
    return float(value) if _finite(value) and fits(float(value)) else _refuse(what, value)


def _refuse(what: str, value: Any) -> NoReturn:
    raise ValueError(f"must be {what}, got {value!r}")
