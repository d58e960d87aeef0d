"""Triangle meshes as files: binary STL, binary PLY, OBJ text."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePath

import numpy as np
from numpy.typing import NDArray

from ..base import Floats, InputError

Indices = NDArray[np.uint32]

STL_HEADER_BYTES = 80
STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
AT_A_TIME = 100_000  # triangles; all of a fine mesh at once would take gigabytes
PLY_TRIANGLE = np.dtype([("count", "u1"), ("corners", "<u4", 3)])


def to_bytes(name: str, vertices: Floats, triangles: Indices) -> bytes:
    """The file `name`, of the kind its ending says: `vertices` (V, 3) mm, `triangles` (T, 3) counter-clockwise seen from
    outside. Raises InputError for an ending that is none of these."""
    return writer(name)(vertices, triangles)


def writer(name: str) -> Callable[[Floats, Indices], bytes]:
    """What writes a file of that name. Raises InputError when nothing does."""
    ending = PurePath(name).suffix.lower()
    if ending not in _WRITERS:
        raise InputError(f"{name}: a mesh file must end in one of {', '.join(_WRITERS)}")
    return _WRITERS[ending]


def _stl(vertices: Floats, triangles: Indices) -> bytes:
    records = np.zeros(len(triangles), dtype=STL_RECORD)
    for first in range(0, len(triangles), AT_A_TIME):
        some = slice(first, first + AT_A_TIME)
        corners = vertices[triangles[some]]
        records["corners"][some] = corners
        records["normal"][some] = _unit_normals(corners)
    header = b"binary STL, mm".ljust(STL_HEADER_BYTES, b" ")
    return b"".join((header, len(triangles).to_bytes(4, "little"), records.data))


def _unit_normals(corners: Floats) -> Floats:
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    return np.divide(normals, lengths, out=np.zeros_like(normals), where=lengths > 0)


def _ply(vertices: Floats, triangles: Indices) -> bytes:
    header = "\n".join(
        [
            "ply",
            "format binary_little_endian 1.0",
            "comment mm",
            f"element vertex {len(vertices)}",
            *(f"property float {axis}" for axis in "xyz"),
            f"element face {len(triangles)}",
            "property list uchar uint vertex_indices",
            "end_header\n",
        ]
    )
    faces = np.zeros(len(triangles), dtype=PLY_TRIANGLE)
    faces["count"] = 3
    faces["corners"] = triangles
    return header.encode() + vertices.astype("<f4").tobytes() + faces.tobytes()


def _obj(vertices: Floats, triangles: Indices) -> bytes:
    lines = ["# mm", *("v %.6f %.6f %.6f" % tuple(v) for v in vertices.tolist())]
    lines += ["f %d %d %d" % tuple(t) for t in (triangles.astype(np.int64) + 1).tolist()]
    return ("\n".join(lines) + "\n").encode()


_WRITERS = {".stl": _stl, ".ply": _ply, ".obj": _obj}
