"""Part files: STEP, IGES and BREP through the native reader, and Bézier patches as text."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from ..base import InputError, one_line
from . import bezier_text
from .faces import FaceArrays

if TYPE_CHECKING:
    from ... import _occt as reader

# How far a side of a trim loop may be from the trimming curve.
DEFAULT_CHORD_MM = 0.01
KERNEL_ENDINGS = (".step", ".stp", ".iges", ".igs", ".brep", ".brp")
TEXT_ENDING = ".txt"


def read_part(path: str | Path, chord_mm: float = DEFAULT_CHORD_MM) -> list[FaceArrays]:
    """All faces of a part file in mm, named Face1, Face2, ... in the order in which FreeCAD numbers them.

    The ending must be one of .step .stp .iges .igs .brep .brp, or .txt for Bézier patches (bezier_text). A
    BREP or text file has no unit and is taken to be in mm. Raises InputError naming the file."""
    path = Path(path)
    ending = path.suffix.lower()
    if ending not in (*KERNEL_ENDINGS, TEXT_ENDING):
        known = " ".join((*KERNEL_ENDINGS, TEXT_ENDING))
        raise InputError(f"{path}: the ending of a part file must be one of {known}, got '{path.suffix}'")
    if not path.exists():
        raise InputError(f"{path}: there is no such file; the part must be a STEP, IGES, BREP or text file")
    if not path.is_file():
        raise InputError(f"{path}: is not a file; the part must be a STEP, IGES, BREP or text file")
    if ending == TEXT_ENDING:
        return bezier_text.read(path)
    return _from_kernel(_occt().read_file, str(path), chord_mm)


def read_brep_string(text: str, chord_mm: float = DEFAULT_CHORD_MM) -> list[FaceArrays]:
    """All faces of a shape given as BREP text (FreeCAD: Shape.exportBrepToString())."""
    return _from_kernel(_occt().read_brep_string, text, chord_mm)


def _occt() -> ModuleType:
    try:
        from ... import _occt
    except ImportError as error:
        raise InputError(f"STEP, IGES and BREP need the native reader _occt: {one_line(error)}") from None
    return _occt


def _from_kernel(
    read: Callable[[str, float], list[reader.FaceTable]], source: str, chord_mm: float
) -> list[FaceArrays]:
    try:
        return [FaceArrays(**face) for face in read(source, chord_mm)]
    except ValueError as error:
        raise InputError(one_line(error)) from None
