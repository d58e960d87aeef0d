"""`exact` where two trimmed faces meet: their borders are polygons and do not quite coincide."""

from __future__ import annotations

import numpy as np

from freecad_mpm import _core
from freecad_mpm.core import job, part
from freecad_mpm.core.base import EXAMPLES, Stages

# Beside the rim of the die's hole: the first contact lies on the edge, and the other face's border 1e-8 mm higher.
POINTS = np.array([[46.36363636, 13.78787879], [40.90909091, 33.48484849], [40.90909091, 35.45454545]])
ASIDE_MM = 0.02
STEEPEST_DEG_PER_MM = 1.0  # seen: 0.9


def test_the_borders_own_mismatch_is_no_touch() -> None:
    stages = Stages(threads=1)
    scene = part.prepare(job.load(EXAMPLES / "bonnet_die.toml"), None, stages)
    positioner = _core.Positioner("exact", scene.model, scene.tool)
    tilts = []
    for aside in ((0, 0), (ASIDE_MM, 0), (-ASIDE_MM, 0), (0, ASIDE_MM), (0, -ASIDE_MM)):
        placed = positioner.place(POINTS + aside, context=_core.Context(1))
        assert (placed["status"] == _core.POSITION_STATUS.index("two_contacts")).all(), aside
        tilts.append(placed["tilt_deg"])
    assert (tilts[0] > 5.0).all()
    # Nothing else happens there: the tilt changes smoothly.
    assert np.ptp(tilts, axis=0).max() < 2 * ASIDE_MM * STEEPEST_DEG_PER_MM
