"""For all tests: the checkout is importable, and the thesis' surfaces are parts."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

# Thesis table 1: z of the control points in mm, row i along x, column j along y, 50 mm apart.
THESIS_HEIGHTS = {
    "convex": [[80, 90, 90, 80], [90, 105, 105, 90], [90, 105, 105, 90], [80, 90, 90, 80]],
    "concave": [[80, 70, 70, 80], [70, 55, 55, 70], [70, 55, 55, 70], [80, 70, 70, 80]],
    "saddle": [[80, 65, 90, 85], [80, 85, 90, 95], [100, 105, 95, 100], [90, 100, 100, 85]],
}


def thesis_poles(name: str) -> np.ndarray:
    """Control points (4, 4, 3) of a surface of thesis table 1."""
    x, y = np.meshgrid(50.0 * np.arange(4), 50.0 * np.arange(4), indexing="ij")
    return np.dstack((x, y, THESIS_HEIGHTS[name]))


@pytest.fixture(scope="session")
def thesis_part(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Name of a thesis surface -> its STEP file."""
    from freecad_mpm import _occt

    folder = tmp_path_factory.mktemp("parts")
    knots = np.repeat([0.0, 1.0], 4)

    def make(name: str) -> Path:
        path = folder / f"{name}.step"
        if not path.exists():
            face = {
                "degree_u": 3,
                "degree_v": 3,
                "knots_u": knots,
                "knots_v": knots,
                "poles": thesis_poles(name),
            }
            _occt.write_step(str(path), [face], name)
        return path

    return make
