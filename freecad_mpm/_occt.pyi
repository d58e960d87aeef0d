"""The door to the OpenCASCADE reader: every name of `_occt`, in the order of native/bindings/occt/module.cpp.

As _core.pyi; lengths in mm, in the frame of the file with all placements applied."""

from collections.abc import Mapping, Sequence
from typing import TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

class FaceTable(TypedDict):
    name: str  # Face1, ... in FreeCAD's order
    kind: str  # plane, cylinder, ..., bspline
    degree_u: int
    degree_v: int
    knots_u: Floats  # (ku,) multiplicities written out
    knots_v: Floats  # (kv,)
    poles: Floats  # (nu, nv, 3) mm
    weights: Floats | None  # (nu, nv); None: not rational
    trim_loops: list[Floats]  # closed polygons (L, 2) in (u, v); none: untrimmed
    reversed: bool  # the material lies on the side of Su x Sv
    deviation_mm: float  # of this surface from the file's; 0: exact

OCC_VERSION: str

def read_file(path: str, chord_mm: float = 0.01) -> list[FaceTable]: ...
def read_brep_string(text: str, chord_mm: float = 0.01) -> list[FaceTable]: ...
def write_step(path: str, faces: Sequence[Mapping[str, object]], name: str = "part") -> None: ...
def evaluate(
    degree_u: int,
    degree_v: int,
    knots_u: ArrayLike,
    knots_v: ArrayLike,
    poles: ArrayLike,  # (nu, nv, 3)
    weights: ArrayLike | None,
    u: ArrayLike,
    v: ArrayLike,
) -> Floats: ...  # (N, 6, 3): S, Su, Sv, Suu, Suv, Svv
