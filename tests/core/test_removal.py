"""Removal: the machined height map and its STL file."""

from types import SimpleNamespace

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core import machined, stl

BALL = _core.Tool(0.0, 5.0, 0.0, 40.0)
UP = np.array([0.0, 0.0, 1.0])


def slot(*tips, kinds=None):
    tip = np.array(tips, dtype=float)
    kind = np.array(kinds or ["rapid"] + ["cut"] * (len(tip) - 1))
    return SimpleNamespace(kind=kind, tip=tip, axis=np.tile(UP, (len(tip), 1)))


def block():
    return np.array([0.0, 0.0, -10.0]), np.array([40.0, 20.0, 5.0])


def test_ball_slot_is_a_half_cylinder():
    result = machined.machine(BALL, slot((-10, 10, 2), (50, 10, 2)), block(), _core.Context(), cell_mm=0.5)
    y = result.lo[1] + result.cell_mm * np.arange(result.z.shape[0])
    expected = np.full_like(y, 5.0)
    under = np.abs(y - 10) < 4.9
    expected[under] = 7 - np.sqrt(25 - (y[under] - 10) ** 2)
    feed_error = (0.5 * result.cell_mm) ** 2 / (8 * 5) + 1e-3
    assert result.z[under] == pytest.approx(
        np.broadcast_to(expected[under, None], result.z[under].shape), abs=2e-2
    )
    assert result.z[y == 10] == pytest.approx(2.0, abs=feed_error)
    assert (result.z[np.abs(y - 10) >= 5] == 5.0).all()


def test_rapids_take_nothing_away():
    moves = slot((-10, 10, 2), (50, 10, 2), kinds=["rapid", "rapid"])
    assert (machined.machine(BALL, moves, block(), _core.Context()).z == 5.0).all()


def test_default_cell_follows_the_longer_side():
    result = machined.machine(BALL, slot((0, 0, 9), (1, 0, 9)), block(), _core.Context())
    assert result.cell_mm == pytest.approx(40.0 / machined.NODES_ALONG)
    assert result.z.shape == (machined.NODES_ALONG // 2 + 1, machined.NODES_ALONG + 1)


def test_same_heights_for_any_number_of_threads():
    moves = slot((0, 0, 0), (40, 20, 3))
    one, two = (machined.machine(BALL, moves, block(), _core.Context(n)).z for n in (1, 2))
    assert np.array_equal(one, two)


def read(data):
    count = int(np.frombuffer(data, "<u4", 1, stl.HEADER_BYTES)[0])
    records = np.frombuffer(data, stl.RECORD, offset=stl.HEADER_BYTES + 4)
    assert len(records) == count
    return records["corners"].astype(float), records["normal"].astype(float)


def signed_volume(triangles):
    return np.einsum("ij,ij->", triangles[:, 0], np.cross(triangles[:, 1], triangles[:, 2])) / 6


def test_solid_is_closed_and_faces_outwards():
    heights = np.array([[1.0, 2.0, 1.5], [2.0, 4.0, 2.0]])
    triangles = stl.solid_below(heights, (10.0, 20.0), 2.0, -1.0)
    edges = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    directed = {(tuple(a), tuple(b)) for a, b in edges}
    assert len(directed) == len(edges)
    assert all((b, a) in directed for a, b in directed)
    flat = stl.solid_below(np.full((3, 4), 5.0), (0.0, 0.0), 2.0, 1.0)
    assert signed_volume(flat) == pytest.approx(6.0 * 4.0 * 4.0)


def test_stl_file_is_in_the_part_frame():
    result = machined.machine(BALL, slot((-10, 10, 2), (50, 10, 2)), block(), _core.Context(), cell_mm=2.0)
    shift = np.array([100.0, 0.0, 0.0])
    corners, normals = read(machined.to_stl(result, lambda points: points + shift))
    assert corners[:, :, 0].min() == 100.0 and corners[:, :, 0].max() == 140.0
    assert corners[:, :, 2].max() == 5.0
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0, abs=1e-6)


def test_errors_name_the_argument():
    with pytest.raises(ValueError, match="cell_mm"):
        machined.machine(BALL, slot((0, 0, 0), (1, 0, 0)), block(), _core.Context(), cell_mm=0.0)
    with pytest.raises(ValueError, match="base_z"):
        stl.solid_below(np.zeros((2, 2)), (0.0, 0.0), 1.0, 0.0)
    with pytest.raises(ValueError, match="heights"):
        stl.solid_below(np.zeros((1, 2)), (0.0, 0.0), 1.0, -1.0)
