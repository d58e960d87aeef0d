"""Faces of a FreeCAD shape as the core's `FaceArrays`.

Two routes with the same answer. Where the native reader was built with the OpenCASCADE that FreeCAD runs, the shape
crosses as BREP text. Elsewhere (a FreeCAD bundle with its own OpenCASCADE) poles, knots and trimming curves are read
through FreeCAD's Python, slower but without sharing a library."""

from __future__ import annotations

from typing import Any

import numpy as np
import Part

from ..core.base import Floats, InputError
from ..core.part import FaceArrays

# Parameters of a piece of a trimming curve where its distance from the chord is looked at.
PROBES = (0.25, 0.5, 0.75)
# A piece is halved at most this often: at a cusp the chord never gets near the curve in a finite number of steps.
HALVINGS_MAX = 12
# A trimming polygon counts as the whole rectangle of its surface within this part of the rectangle's size.
RECTANGLE_EPSILON = 1e-9
# FreeCAD's classes of surfaces -> the core's names.
KINDS = {
    "Plane": "plane",
    "Cylinder": "cylinder",
    "Cone": "cone",
    "Sphere": "sphere",
    "Toroid": "torus",
    "SurfaceOfRevolution": "revolution",
    "SurfaceOfExtrusion": "extrusion",
    "BezierSurface": "bezier",
    "BSplineSurface": "bspline",
    "OffsetSurface": "offset",
}


def global_shape(obj: Any) -> Any:
    """The shape of a document object where it stands in the document's frame, whatever parts and links hold it."""
    shape = Part.getShape(obj)
    if shape.isNull():
        raise InputError(f"'{obj.Label}': must have a shape with faces")
    outside = obj.getGlobalPlacement().multiply(obj.Placement.inverse())  # of what holds the object
    return shape if outside.isIdentity() else shape.transformed(outside.toMatrix(), copy=True)


def read_faces(shape: Any, chord_mm: float) -> list[FaceArrays]:
    """All faces of `shape` in the shape's frame (mm), named Face1, Face2, ... as FreeCAD names them.

    `chord_mm` is how far the trimming polygons may be from the trimming curves. Raises InputError naming the face.
    """
    reader = _reader_of_this_kernel()
    if reader is not None:
        return reader(shape.exportBrepToString(), chord_mm)
    return [_face_arrays(face, f"Face{number}", chord_mm) for number, face in enumerate(shape.Faces, 1)]


def _reader_of_this_kernel() -> Any:
    """The native BREP reader, or None when it is missing or was built with another OpenCASCADE than FreeCAD's."""
    try:
        from .. import _occt
        from ..core.part import file
    except ImportError:
        return None
    return file.read_brep_string if _occt.OCC_VERSION == Part.OCC_VERSION else None


def _face_arrays(face: Any, name: str, chord_mm: float) -> FaceArrays:
    try:
        nurbs = face.toNurbs().Faces[0]
        surface = _not_periodic(nurbs.Surface)
    except (Part.OCCError, AttributeError) as error:
        raise InputError(f"{name}: cannot be converted to a B-spline surface: {error}") from None
    poles = np.array([[tuple(pole) for pole in row] for row in surface.getPoles()])
    weights = np.array(surface.getWeights())
    loops = [_polygon(nurbs, wire, surface, chord_mm) for wire in nurbs.Wires]
    return FaceArrays(
        name=name,
        kind=KINDS.get(type(face.Surface).__name__, "other"),
        degree_u=surface.UDegree,
        degree_v=surface.VDegree,
        knots_u=np.repeat(surface.getUKnots(), surface.getUMultiplicities()),
        knots_v=np.repeat(surface.getVKnots(), surface.getVMultiplicities()),
        poles=poles,
        weights=weights if surface.isURational() or surface.isVRational() else None,
        reversed=face.Orientation == "Reversed",
        trim_loops=[] if _is_whole(loops, surface.bounds()) else loops,
    )


def _not_periodic(surface: Any) -> Any:
    surface = surface.copy()
    if surface.isUPeriodic():
        surface.setUNotPeriodic()
    if surface.isVPeriodic():
        surface.setVNotPeriodic()
    return surface


def _polygon(face: Any, wire: Any, surface: Any, chord_mm: float) -> Floats:
    """The closed polygon (N, 2) in (u, v) of one wire; its last point is not its first."""
    points: list[tuple[float, float]] = []
    for edge in wire.OrderedEdges:
        curve, first, last = face.curveOnSurface(edge)
        ends = (first, last) if edge.Orientation == "Forward" else (last, first)
        points += _sample(curve, *ends, surface, chord_mm, HALVINGS_MAX)
    return np.array(points)


def _sample(curve: Any, start: float, end: float, surface: Any, chord_mm: float, halvings: int) -> list[Any]:
    """Points of the curve from `start` up to but without `end`, so near that the chords are within `chord_mm`."""
    a, b = curve.value(start), curve.value(end)
    if halvings == 0 or all(_chord_error(curve, start, end, a, b, t, surface) <= chord_mm for t in PROBES):
        return [(a.x, a.y)]
    middle = (start + end) / 2
    rest = (surface, chord_mm, halvings - 1)
    return _sample(curve, start, middle, *rest) + _sample(curve, middle, end, *rest)


def _chord_error(curve: Any, start: float, end: float, a: Any, b: Any, t: float, surface: Any) -> float:
    """Distance on the surface, mm, between the curve and its chord a..b at the part t of the way."""
    on_curve = curve.value(start + t * (end - start))
    on_chord = a + (b - a) * t
    return surface.value(on_curve.x, on_curve.y).distanceToPoint(surface.value(on_chord.x, on_chord.y))


def _is_whole(loops: list[Floats], bounds: tuple[float, float, float, float]) -> bool:
    """Whether the only polygon is the rectangle of the surface's parameters."""
    if len(loops) != 1:
        return False
    u0, u1, v0, v1 = bounds
    low, size = np.array([u0, v0]), np.array([u1 - u0, v1 - v0])
    relative = (loops[0] - low) / size
    on_border = np.abs(np.abs(relative - 0.5) - 0.5) <= RECTANGLE_EPSILON
    corners = np.unique(relative[on_border.all(axis=1)].round(), axis=0)
    return bool(on_border.any(axis=1).all() and len(corners) == 4)
