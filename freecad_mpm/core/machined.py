"""The machined surface: what the path leaves of a block of stock, as a height map and as an STL file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from .. import _core
from . import stl

Floats = NDArray[np.float64]

# Nodes along the longer side of the stock: a 150 mm part gets cells of 0.5 mm.
NODES_ALONG = 300
# Poses are simulated so densely that no point of the tool moves more than this part of a cell between two.
STEP_CELLS = 0.5
# The solid's base lies this part of the stock's height below its lowest point.
BASE_DEPTH = 0.1


class Moves(Protocol):
    """What is needed of a path: `kind` (M,) names, `tip` and `axis` (M, 3)."""

    kind: NDArray[np.str_]
    tip: Floats
    axis: Floats


@dataclass(frozen=True, eq=False)
class Machined:
    """Heights `z` (rows, columns), mm, over the points lo + (column, row) * cell_mm of the set-up frame."""

    lo: Floats
    cell_mm: float
    z: Floats


def machine(
    tool: _core.Tool,
    path: Moves,
    bounds: tuple[Floats, Floats],
    context: Any,
    cell_mm: float | None = None,
) -> Machined:
    """Move `tool` along `path` (set-up frame) through a block that fills the box `bounds` (lo, hi) (mm).

    All moves but rapids take material away. cell_mm: of the height map; default: the longer side / NODES_ALONG.
    Raises ValueError naming the argument that is wrong."""
    lo, hi = (np.asarray(corner, dtype=np.float64) for corner in bounds)
    cell = float((hi - lo)[:2].max()) / NODES_ALONG if cell_mm is None else cell_mm
    z = _core.machined_heights(
        tool,
        path.tip,
        path.axis,
        path.kind != "rapid",
        lo[:2],
        hi[:2],
        cell_mm=cell,
        top_mm=float(hi[2]),
        step_mm=STEP_CELLS * cell,
        context=context,
    )
    return Machined(lo[:2], cell, z)


def to_stl(machined: Machined, to_part: Callable[[Floats], Floats]) -> bytes:
    """Binary STL of the solid below the machined surface; `to_part` carries set-up points (N, 3) to the part frame."""
    lowest, highest = float(machined.z.min()), float(machined.z.max())
    base = lowest - max(BASE_DEPTH * (highest - lowest), machined.cell_mm)
    triangles = stl.solid_below(machined.z, machined.lo, machined.cell_mm, base)
    return stl.to_bytes(to_part(triangles.reshape(-1, 3)).reshape(-1, 3, 3))
