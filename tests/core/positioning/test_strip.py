"""The strip that a position machines."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core.part import FaceArrays
from freecad_mpm.core.positioning import strip


@pytest.mark.parametrize("scallop_mm", [0.02, 0.1])
def test_the_strip_on_a_floor_is_that_of_the_ring(scallop_mm: float) -> None:
    """Upright on a plane the ring is within h of it from edge to edge: 2 (Ro + sqrt(Ri² - (Ri - h)²))."""
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    poles = np.array([[[0, 0, 0], [0, 100, 0]], [[100, 0, 0], [100, 100, 0]]], dtype=float)
    floor = FaceArrays("Face1", "plane", 1, 1, knots, knots, poles)
    tool = _core.Tool(6.7, 6.0, 6.0, 40.0)
    ground = strip.ground_under([floor], np.array([50.0, 50.0]), tool.radius)
    found = strip.width_mm(
        tool,
        np.array([50.0, 50.0, 0.0]),
        np.array([0.0, 0.0, 1.0]),
        np.array([56.7, 50.0, 0.0]),
        ground,
        np.array([0.0, 1.0, 0.0]),
        scallop_mm,
    )
    right = 2 * (6.7 + np.sqrt(6.0**2 - (6.0 - scallop_mm) ** 2))
    assert found == pytest.approx(right, abs=3 * strip.STEP_PER_RADIUS * tool.radius)
