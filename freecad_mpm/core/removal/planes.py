"""The planes of sections as the command line names them."""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..base import InputError

FORMS = "x=MM, y=MM, z=MM, line=X,Y:X,Y or point=X,Y,Z:normal=X,Y,Z"
AXES = "xyz"

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class NamedPlane:
    """A plane through `origin` square to `normal` (part frame, mm), and a name that a file can bear."""

    name: str
    origin: Vector
    normal: Vector


def parse(text: str) -> NamedPlane:
    """One of FORMS, part frame: square to an axis; upright through two points in plan; through a point, square to a
    direction. Raises InputError."""
    kind, _, rest = text.partition("=")
    if len(kind) == 1 and kind in AXES:
        (at,) = _numbers(text, rest, 1)
        axis = AXES.index(kind)
        origin, normal = ([value if i == axis else 0.0 for i in range(3)] for value in (at, 1.0))
        return NamedPlane(f"{kind}{at:g}", _vector(origin), _vector(normal))
    first, _, second = rest.partition(":")
    if kind == "line":
        (x0, y0), (x1, y1) = _numbers(text, first, 2), _numbers(text, second, 2)
        return _named("line", (x0, y0, x1, y1), (x0, y0, 0.0), (y0 - y1, x1 - x0, 0.0), text)
    if kind == "point" and second.startswith("normal="):
        origin, normal = _numbers(text, first, 3), _numbers(text, second.removeprefix("normal="), 3)
        return _named("plane", (*origin, *normal), _vector(origin), _vector(normal), text)
    raise _error(text)


def _named(kind: str, numbers: tuple[float, ...], origin: Vector, normal: Vector, text: str) -> NamedPlane:
    if not any(normal):
        raise InputError(
            f"--section: '{text}' has no direction: its points must differ, its normal must not be 0"
        )
    return NamedPlane("_".join([kind, *(f"{value:g}" for value in numbers)]), origin, normal)


def _numbers(text: str, words: str, count: int) -> list[float]:
    try:
        found = [float(word) for word in words.split(",")]
    except ValueError:
        raise _error(text) from None
    if len(found) != count or not all(map(math.isfinite, found)):
        raise _error(text)
    return found


def _vector(numbers: list[float]) -> Vector:
    x, y, z = numbers
    return x, y, z


def _error(text: str) -> InputError:
    return InputError(f"--section: must be {FORMS}, got '{text}'")
