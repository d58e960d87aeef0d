"""Binary STL: triangles to bytes, and the closed solid below a height map."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

HEADER_BYTES = 80
RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def to_bytes(triangles: Floats) -> bytes:
    """A binary STL file of `triangles` (T, 3 corners, 3), mm, counter-clockwise seen from outside."""
    records = np.zeros(len(triangles), dtype=RECORD)
    records["corners"] = triangles
    records["normal"] = _unit_normals(triangles)
    header = b"binary STL, mm".ljust(HEADER_BYTES, b" ")
    return header + len(triangles).to_bytes(4, "little") + records.tobytes()


def _unit_normals(triangles: Floats) -> Floats:
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)


def solid_below(heights: Floats, lo: ArrayLike, cell_mm: float, base_z: float) -> Floats:
    """Triangles (T, 3, 3) of the closed solid between a height map and the plane z = `base_z`.

    heights: (rows, columns), at x = lo[0] + column * cell_mm, y = lo[1] + row * cell_mm; at least 2 x 2.
    base_z:  below all heights. Raises ValueError naming the argument that is not so."""
    if heights.ndim != 2 or min(heights.shape) < 2:
        raise ValueError(f"heights must have at least 2 rows and 2 columns, got shape {heights.shape}")
    if not base_z < heights.min():
        raise ValueError(f"base_z must be below all heights ({heights.min():g}), got {base_z:g}")
    top = _nodes(heights, np.asarray(lo, dtype=np.float64), cell_mm)
    rim = _rim(top)
    foot = rim.copy()
    foot[:, 2] = base_z
    return np.concatenate([_skin(top), _wall(rim, foot), _floor(foot)])


def _nodes(heights: Floats, lo: Floats, cell_mm: float) -> Floats:
    rows, columns = heights.shape
    x, y = np.meshgrid(lo[0] + cell_mm * np.arange(columns), lo[1] + cell_mm * np.arange(rows))
    return np.stack([x, y, heights], axis=-1)


def _skin(nodes: Floats) -> Floats:
    """Two triangles a cell, facing up."""
    a, b = nodes[:-1, :-1], nodes[:-1, 1:]
    c, d = nodes[1:, 1:], nodes[1:, :-1]
    triangles: Floats = np.stack([np.stack([a, b, c], axis=2), np.stack([a, c, d], axis=2)], axis=2)
    return triangles.reshape(-1, 3, 3)


def _rim(nodes: Floats) -> Floats:
    """The border nodes, counter-clockwise seen from above, the first not repeated."""
    return np.concatenate([nodes[0, :-1], nodes[:-1, -1], nodes[-1, :0:-1], nodes[:0:-1, 0]])


def _wall(rim: Floats, foot: Floats) -> Floats:
    next_rim, next_foot = np.roll(rim, -1, axis=0), np.roll(foot, -1, axis=0)
    lower = np.stack([rim, foot, next_foot], axis=1)
    upper = np.stack([rim, next_foot, next_rim], axis=1)
    return np.concatenate([lower, upper])


def _floor(foot: Floats) -> Floats:
    """A fan round the middle, facing down: it has the walls' edges, so the solid is closed."""
    middle = np.broadcast_to(foot.mean(axis=0), foot.shape)
    return np.stack([middle, np.roll(foot, -1, axis=0), foot], axis=1)
