"""Bicubic Bézier patches as text, the form in which Newell's teapot is handed down.

The first line is the number of patches; one line for each follows with 16 vertex numbers, counted from one,
row by row; then the number of vertices and one line `x,y,z` for each. Numbers may be parted by commas or
blanks."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from ..base import InputError
from .faces import FaceArrays

DEGREE = 3
ROW = DEGREE + 1
KNOTS = np.repeat([0.0, 1.0], ROW)

Number = TypeVar("Number", int, float)


def read(path: Path) -> list[FaceArrays]:
    """The patches as faces, in mm. Raises InputError naming the file and the line."""
    lines = _Lines(path)
    patches = [lines.numbers(int, ROW * ROW, "vertex numbers") for _ in range(lines.count("patches"))]
    vertices = [lines.numbers(float, 3, "coordinates x,y,z") for _ in range(lines.count("vertices"))]
    points = np.array(vertices)
    if not np.isfinite(points).all():
        raise InputError(f"{path}: coordinates must be finite numbers")
    return [_face(path, number, np.array(patch), points) for number, patch in enumerate(patches, 1)]


def _face(path: Path, number: int, patch: NDArray[np.int64], points: NDArray[np.float64]) -> FaceArrays:
    wrong = patch[(patch < 1) | (patch > len(points))]
    if wrong.size:
        raise InputError(f"{path}: patch {number}: vertex numbers must be 1 to {len(points)}, got {wrong[0]}")
    poles = points[patch - 1].reshape(ROW, ROW, 3)
    return FaceArrays(f"Face{number}", "bezier", DEGREE, DEGREE, KNOTS, KNOTS, poles)


class _Lines:
    """The lines of the file that are not empty, one after the other."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            text = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is not text"
            raise InputError(f"{path}: cannot be read: {reason}") from None
        self._lines = [(number, line) for number, line in enumerate(text.splitlines(), 1) if line.strip()]
        self._next = 0

    def count(self, what: str) -> int:
        number = self.numbers(int, 1, f"number of {what}")[0]
        if not 1 <= number <= len(self._lines):
            raise self._error(
                f"the number of {what} must be 1 or more, with as many lines after it, got {number}"
            )
        return number

    def numbers(self, kind: Callable[[str], Number], length: int, what: str) -> list[Number]:
        if self._next == len(self._lines):
            raise self._error(f"the file ends where {length} {what} should follow")
        line = self._lines[self._next][1]
        self._next += 1
        try:
            values = [kind(word) for word in line.replace(",", " ").split()]
        except ValueError:
            values = []
        if len(values) != length:
            raise self._error(f"must have {length} {what}, got '{line.strip()[:60]}'")
        return values

    def _error(self, message: str) -> InputError:
        number = self._lines[self._next - 1][0] if self._next else 1
        return InputError(f"{self._path}: line {number}: {message}")
