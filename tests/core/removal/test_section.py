"""Sections at any plane: what the command line takes, the curve on the true surface, and scallops in closed form."""

from __future__ import annotations

import csv

import numpy as np
import pytest
from cut_samples import BALL_MM, BOX, passes_over, plane, scene_of

from freecad_mpm.core import removal
from freecad_mpm.core.part import FaceArrays
from freecad_mpm.core.pictures import section
from freecad_mpm.core.removal import planes
from freecad_mpm.core.removal.plane_curve import curve

SIDE_STEP = 3.0


@pytest.mark.parametrize(
    "text", ["y=21.3", "line=3,5:31,38", "point=20,20,10:normal=1,1,1", "point=20,20,10:normal=1,2,-0.3"]
)
def test_scallops_in_any_plane_have_their_closed_form(text: str) -> None:
    """A ball's passes along y on a plane that rises along x: the groove is r - sqrt(r^2 - d^2) high, d along
    the slope from its middle."""
    slope, named = 0.5, planes.parse(text)
    cut = removal.cut(scene_of(plane(slope)), passes_over(slope, SIDE_STEP), 2.0, box=BOX, with_stock=False)
    found = cut.section(named.origin, named.normal, 0.05)
    offset = (found.points - named.origin) @ np.array(named.normal)
    assert np.abs(offset).max() < 1e-9
    assert found.points[:, 2] == pytest.approx(slope * found.points[:, 0], abs=1e-9)
    steps = np.linalg.norm(np.diff(found.points, axis=0), axis=1)
    assert 0 < steps.min() and steps.max() < 0.051 and found.piece.max() == 0
    assert found.way_mm[-1] == pytest.approx(np.linalg.norm(found.points[-1] - found.points[0]))
    across = np.abs(found.points[:, 0] - SIDE_STEP * np.round(found.points[:, 0] / SIDE_STEP))
    height = BALL_MM - np.sqrt(BALL_MM**2 - (across * np.hypot(1, slope)) ** 2)
    assert found.deviation_mm == pytest.approx(height, abs=1e-6)
    assert (np.diff(found.s_mm) > 0).all()


def test_a_level_section_of_a_slope_runs_along_one_pass() -> None:
    slope = 0.5
    cut = removal.cut(scene_of(plane(slope)), passes_over(slope, SIDE_STEP), 2.0, box=BOX, with_stock=False)
    for x in (9.0, 10.5):
        found = cut.section((0, 0, slope * x), (0, 0, 1))
        along = (x % SIDE_STEP) * np.hypot(1, slope)
        assert found.points[:, 0] == pytest.approx(x, abs=1e-9)
        assert found.way_mm[-1] == pytest.approx(40)
        assert found.deviation_mm == pytest.approx(BALL_MM - np.sqrt(BALL_MM**2 - along**2), abs=1e-6)


def bowl() -> FaceArrays:
    """z = (x^2 + y^2) / 20 over a square of side 40."""
    knots = np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])
    at, square = (-20.0, 0.0, 20.0), (400.0, -400.0, 400.0)  # Bézier ordinates of x and of x^2
    poles = np.array([[[x, y, (a + b) / 20] for y, b in zip(at, square)] for x, a in zip(at, square)])
    return FaceArrays("Face1", "bspline", 2, 2, knots, knots, poles)


def test_a_level_section_may_be_a_circle_or_four_pieces() -> None:
    scene = scene_of(bowl())
    circle = curve(scene, (0, 0, 5), (0, 0, -2), 0.05)
    assert np.linalg.norm(circle.points[:, :2], axis=1) == pytest.approx(10, abs=1e-9)
    assert circle.points[0] == pytest.approx(circle.points[-1], abs=1e-9)
    way = np.linalg.norm(np.diff(circle.points, axis=0), axis=1).sum()
    assert way == pytest.approx(2 * np.pi * 10, rel=1e-4)
    assert curve(scene, (0, 0, 30), (0, 0, 1), 0.05).piece.max() == 3  # beyond the middles of the sides


def test_a_plane_that_misses_and_one_that_is_none() -> None:
    scene = scene_of(bowl())
    with pytest.raises(ValueError, match="does not meet the faces"):
        curve(scene, (0, 0, 50), (0, 0, 1), 0.05)
    with pytest.raises(ValueError, match="normal must not be zero"):
        curve(scene, (0, 0, 5), (0, 0, 0), 0.05)
    with pytest.raises(ValueError, match="spacing_mm"):
        curve(scene, (0, 0, 5), (0, 0, 1), 0.0)


def test_table_and_picture_of_a_closed_section() -> None:
    scene = scene_of(bowl())
    path = passes_over(0.0, SIDE_STEP)
    path.tip[:, 2] += 45  # nothing is cut
    found = removal.cut(scene, path, 2.0, with_stock=False).section((0, 0, 5), (0, 0, 1), 0.5)
    rows = list(csv.DictReader(found.to_csv().splitlines()))
    assert len(rows) == len(found.points) and {row["piece"] for row in rows} == {"0"}
    assert float(rows[-1]["way_mm"]) == pytest.approx(2 * np.pi * 10, rel=1e-3)
    assert section.render(found, "circle").startswith(b"\x89PNG")
