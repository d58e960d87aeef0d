"""Mesh files, read back by what their formats say."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm.core.base import InputError
from freecad_mpm.core.removal import mesh_file

VERTICES = np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]])
TRIANGLES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], dtype=np.uint32)


def test_stl_has_the_corners_and_outward_normals() -> None:
    data = mesh_file.to_bytes("a.stl", VERTICES, TRIANGLES)
    count = int(np.frombuffer(data, "<u4", 1, 80)[0])
    layout = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    records = np.frombuffer(data, layout, offset=84)
    assert count == len(records) == 4
    assert records["corners"] == pytest.approx(VERTICES[TRIANGLES])
    assert records["normal"][0] == pytest.approx([0, 0, -1])
    assert (records["normal"][3] > 0).all() and np.linalg.norm(records["normal"][3]) == pytest.approx(1)


def test_ply_has_the_vertices_and_faces() -> None:
    data = mesh_file.to_bytes("a.PLY", VERTICES, TRIANGLES)
    head, body = data.split(b"end_header\n")
    assert head.startswith(b"ply\nformat binary_little_endian 1.0\n")
    assert b"element vertex 4\n" in head and b"element face 4\n" in head
    assert np.frombuffer(body, "<f4", 12).reshape(4, 3) == pytest.approx(VERTICES)
    faces = np.frombuffer(body, np.dtype([("count", "u1"), ("corners", "<u4", 3)]), offset=48)
    assert (faces["count"] == 3).all() and np.array_equal(faces["corners"], TRIANGLES)


def test_obj_counts_from_one() -> None:
    lines = mesh_file.to_bytes("a.obj", VERTICES, TRIANGLES).decode().splitlines()
    vertices = [tuple(map(float, line.split()[1:])) for line in lines if line.startswith("v ")]
    faces = [tuple(map(int, line.split()[1:])) for line in lines if line.startswith("f ")]
    assert np.array(vertices) == pytest.approx(VERTICES)
    assert np.array_equal(np.array(faces) - 1, TRIANGLES)


def test_another_ending_is_refused() -> None:
    with pytest.raises(InputError, match=r"a\.3mf: .*\.stl, \.ply, \.obj"):
        mesh_file.writer("a.3mf")
