"""What a probe finds of a section."""

from __future__ import annotations

import numpy as np
import pytest
from cut_samples import BALL_MM, BOX, passes_over, plane, scene_of

from freecad_mpm.core import removal
from freecad_mpm.core.removal import probed


def test_a_ball_probe_rests_on_the_cusps() -> None:
    """Between two cusps that lie farther apart than it goes down, the ball hangs on both."""
    side_step, radius = 3.0, 4.0
    cut = removal.cut(scene_of(plane(0.0)), passes_over(0.0, side_step), 0.5, box=BOX, with_stock=False)
    section = cut.section((0, 20, 0), (0, 1, 0), 0.05)
    scallop = BALL_MM - np.sqrt(BALL_MM**2 - side_step**2 / 4)
    inner = (section.s_mm > 8) & (section.s_mm < 32)
    found = probed(cut, section, radius)[inner]
    # A probe smaller than the ball that cut touches the groove's bottom; at the cusp it reads the cusp.
    assert found.min() == pytest.approx(0.0, abs=0.01) and found.max() == pytest.approx(scallop, abs=0.01)
    wide = probed(cut, section, 20.0)[inner]
    assert wide.min() == pytest.approx(scallop - (20 - np.sqrt(400 - side_step**2 / 4)), abs=0.01)
