"""The set-up frame."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm.core.job import Setup
from freecad_mpm.core.part.frame import frame_of

SETUPS = [
    Setup(),
    Setup((1.0, 2.0, 3.0), (0.0, 0.0, -2.0)),
    Setup((-5.0, 0.1, 9.0), (1.0, 2.0, 3.0), (0.3, -1.0, 0.2)),
]
POINTS = np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 3.5], [1e3, 1e-3, -7.0]])


@pytest.mark.parametrize("setup", SETUPS)
def test_it_is_right_handed_and_orthonormal(setup: Setup) -> None:
    axes = frame_of(setup).axes
    assert axes.T @ axes == pytest.approx(np.eye(3), abs=1e-15)
    assert np.linalg.det(axes) == pytest.approx(1.0)


@pytest.mark.parametrize("setup", SETUPS)
def test_z_and_origin_are_the_set_ups(setup: Setup) -> None:
    frame = frame_of(setup)
    z = np.array(setup.z)
    assert frame.direction_to_setup(z) == pytest.approx([0, 0, np.linalg.norm(z)])
    assert frame.to_setup(np.array(setup.origin)).tolist() == [0.0, 0.0, 0.0]
    x = frame.direction_to_setup(np.array(setup.x))
    assert x[0] > 0 and x[1] == pytest.approx(0)


@pytest.mark.parametrize("setup", SETUPS)
def test_there_and_back(setup: Setup) -> None:
    frame = frame_of(setup)
    assert frame.to_part(frame.to_setup(POINTS)) == pytest.approx(POINTS)


def test_the_default_changes_no_bit() -> None:
    frame = frame_of(Setup())
    assert (frame.to_part(frame.to_setup(POINTS)) == POINTS).all()
    assert np.isnan(frame.to_part(np.full(3, np.nan))).all()
