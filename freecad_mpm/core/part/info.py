"""What a part file holds, as lines of text for a person."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ... import _core
from .faces import FaceArrays, to_core
from .file import read_part

HEADINGS = ("face", "kind", "degree", "poles", "rational", "trim loops", "x mm", "y mm", "z mm", "exact")


def info_lines(path: str | Path) -> list[str]:
    """A heading and one line a face; 0 trim loops: untrimmed. Raises InputError naming the file."""
    return _table([HEADINGS, *(_row(face) for face in read_part(path))])


def _row(face: FaceArrays) -> tuple[str, ...]:
    nu, nv, _ = face.poles.shape
    return (
        face.name,
        face.kind,
        f"{face.degree_u}x{face.degree_v}",
        f"{nu}x{nv}",
        "yes" if face.rational else "no",
        str(len(face.trim_loops)),
        *_box(face),
        "yes" if face.deviation_mm == 0 else f"to {face.deviation_mm:.1g} mm",
    )


def _box(face: FaceArrays) -> list[str]:
    lo, hi = _core.SurfaceModel([to_core(face)]).machined_bounds()
    return [f"{a:.3f} .. {b:.3f}" for a, b in zip(lo, hi)]


def _table(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows)]
    return ["  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows]
