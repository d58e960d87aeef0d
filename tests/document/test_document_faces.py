"""Faces as arrays: both routes out of FreeCAD against FreeCAD's own evaluation and trimming."""

from __future__ import annotations

from typing import Any

import numpy as np
import Part
import pytest
from FreeCAD import Placement, Rotation, Vector
from parts import wave

from freecad_mpm import _core
from freecad_mpm.core.base import InputError
from freecad_mpm.document import faces

CHORD_MM = 0.001
# Rounding of a surface of some 100 mm, after conversions by two programs.
SAME_POINT_MM = 1e-9


def drilled_plate() -> Any:
    return Part.makeBox(40, 30, 10).cut(Part.makeCylinder(6, 30, Vector(20, 15, -5)))


def trimmed_wave() -> Any:
    hole = Part.makeCylinder(8, 40, Vector(25, 20, -20))
    return wave().toShape().cut(hole)


SHAPES = {
    "wave": lambda: wave().toShape(),
    "trimmed wave": trimmed_wave,
    "drilled plate": drilled_plate,
    "cylinder": lambda: Part.makeCylinder(5, 10),
    "half cylinder": lambda: Part.makeCylinder(5, 10).common(Part.makeBox(20, 20, 20, Vector(0, -10, -5))),
    "cone": lambda: Part.makeCone(6, 2, 10),
    "sphere": lambda: Part.makeSphere(7),
    "torus": lambda: Part.makeTorus(12, 3),
}


@pytest.fixture(params=["brep text", "python"])
def route(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> str:
    if request.param == "python":
        monkeypatch.setattr(faces, "_reader_of_this_kernel", lambda: None)
    else:
        assert faces._reader_of_this_kernel() is not None, "_occt must be built with FreeCAD's OpenCASCADE"
    return str(request.param)


def native(face: faces.FaceArrays) -> _core.BSplineSurface:
    return _core.BSplineSurface(
        face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights
    )


def points_inside(face: faces.FaceArrays, count: int = 12) -> np.ndarray:
    """Points (N, 3) of the arrays' surface at parameters that its trim loops keep."""
    surface = native(face)
    u0, u1, v0, v1 = surface.domain
    grid = np.stack(
        np.meshgrid(np.linspace(u0, u1, count + 2)[1:-1], np.linspace(v0, v1, count + 2)[1:-1]), -1
    )
    inside = kept(face.trim_loops, grid.reshape(-1, 2))
    return surface.evaluate(inside[:, 0], inside[:, 1])[:, 0]


def kept(loops: Any, uv: np.ndarray) -> np.ndarray:
    """Those of the points (N, 2) that are inside the loops by the even-odd rule."""
    inside = np.full(len(uv), len(loops) == 0)
    u, v = uv.T
    for loop in loops:
        for (u0, v0), (u1, v1) in zip(loop, np.roll(loop, -1, axis=0)):
            if v0 != v1:
                inside ^= ((v0 > v) != (v1 > v)) & (u < u0 + (v - v0) * (u1 - u0) / (v1 - v0))
    return uv[inside]


@pytest.mark.parametrize("name", SHAPES)
def test_points_of_the_arrays_lie_on_the_face(name: str, route: str) -> None:
    shape = SHAPES[name]()
    arrays = faces.read_faces(shape, CHORD_MM)
    assert [face.name for face in arrays] == [f"Face{i + 1}" for i in range(len(shape.Faces))]
    for face, original in zip(arrays, shape.Faces):
        for point in points_inside(face):
            assert original.distToShape(Part.Vertex(*point))[0] < 1e-6


@pytest.mark.parametrize("name", SHAPES)
def test_area_inside_the_trim_loops_is_the_area_of_the_face(name: str, route: str) -> None:
    shape = SHAPES[name]()
    for face, original in zip(faces.read_faces(shape, CHORD_MM), shape.Faces):
        assert area(face) == pytest.approx(original.Area, rel=0.02)


def area(face: faces.FaceArrays, count: int = 120) -> float:
    surface = native(face)
    u0, u1, v0, v1 = surface.domain
    u, v = ((np.arange(count) + 0.5) / count * (b - a) + a for a, b in ((u0, u1), (v0, v1)))
    grid = np.stack(np.meshgrid(u, v), -1).reshape(-1, 2)
    inside = kept(face.trim_loops, grid)
    rows = surface.evaluate(inside[:, 0], inside[:, 1])
    cells = np.linalg.norm(np.cross(rows[:, 1], rows[:, 2]), axis=1)
    return float(cells.sum()) * (u1 - u0) * (v1 - v0) / count**2


def test_b_spline_faces_keep_their_poles_and_parameters(route: str) -> None:
    original = wave()
    (face,) = faces.read_faces(original.toShape(), CHORD_MM)
    assert (face.degree_u, face.degree_v, face.weights) == (original.UDegree, original.VDegree, None)
    assert len(face.trim_loops) == 0
    for u, v in ((0.1, 0.9), (0.5, 0.5), (1.0, 0.0)):
        point = native(face).evaluate(np.array([u]), np.array([v]))[0, 0]
        assert np.abs(point - np.array(original.value(u, v))).max() < SAME_POINT_MM


def test_rational_faces_keep_their_weights(route: str) -> None:
    cylinder = faces.read_faces(Part.makeCylinder(5, 10), CHORD_MM)[0]
    assert cylinder.kind == "cylinder"
    assert cylinder.weights is not None
    radii = np.linalg.norm(points_inside(cylinder)[:, :2], axis=1)
    assert np.abs(radii - 5).max() < SAME_POINT_MM


def test_trim_loops_are_within_the_chord_of_the_trimming_curves(route: str) -> None:
    shape = trimmed_wave()
    (face,) = faces.read_faces(shape, CHORD_MM)
    assert len(face.trim_loops) == 2
    surface, edges = native(face), Part.Compound(shape.Edges)
    for loop in face.trim_loops:
        middles = (loop + np.roll(loop, -1, axis=0)) / 2
        for point in surface.evaluate(middles[:, 0], middles[:, 1])[:, 0]:
            assert edges.distToShape(Part.Vertex(*point))[0] < 2 * CHORD_MM


def test_both_routes_give_the_same_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    shape = drilled_plate()
    through_kernel = faces.read_faces(shape, CHORD_MM)
    monkeypatch.setattr(faces, "_reader_of_this_kernel", lambda: None)
    for one, other in zip(through_kernel, faces.read_faces(shape, CHORD_MM)):
        assert (one.name, one.kind, one.reversed) == (other.name, other.kind, other.reversed)
        assert len(one.trim_loops) == len(other.trim_loops)
        assert one.poles.shape == other.poles.shape
        assert np.abs(one.poles - other.poles).max() < SAME_POINT_MM


def test_the_kernel_route_is_not_taken_with_another_opencascade(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Part, "OCC_VERSION", "6.9.1")
    assert faces._reader_of_this_kernel() is None


def test_a_placed_part_gives_its_faces_where_they_stand(doc: Any, route: str) -> None:
    holder = doc.addObject("App::Part", "Holder")
    holder.Placement = Placement(Vector(100, 0, 5), Rotation(Vector(0, 0, 1), 90))
    box = doc.addObject("Part::Box", "Box")
    box.Placement = Placement(Vector(0, 50, 0), Rotation())
    holder.addObject(box)
    doc.recompute()
    poles = np.concatenate(
        [face.poles.reshape(-1, 3) for face in faces.read_faces(faces.global_shape(box), CHORD_MM)]
    )
    # The box spans (0..10, 50..60, 0..10) in the holder: turned by 90 degrees and moved.
    assert poles.min(axis=0) == pytest.approx([40, 0, 5])
    assert poles.max(axis=0) == pytest.approx([50, 10, 15])


def test_an_object_without_a_shape_is_refused(doc: Any) -> None:
    with pytest.raises(InputError, match="'Empty': must have a shape"):
        faces.global_shape(doc.addObject("Part::Feature", "Empty"))
