"""`exact` against drop and tilt by brute force, which shares no code with it."""

from __future__ import annotations

import math

import numpy as np
import pytest
from reference import Patch, tilt_of

from freecad_mpm import _core
from freecad_mpm.core import job
from freecad_mpm.core.base import Stages
from freecad_mpm.core.part import file, prepare
from freecad_mpm.core.positioning import lay_out

TWO_CONTACTS = _core.POSITION_STATUS.index("two_contacts")
SIDE_MM, EVERY = 150.0, 95
TILT_DEG = 2e-4  # where both contacts are about to merge, 1e-9 mm of depth is as much


@pytest.mark.parametrize("name", ["convex", "concave", "saddle"])
def test_tilts_are_those_of_brute_force(name: str) -> None:
    spec = job.load(f"resources/examples/{name}.toml")
    stages = Stages(threads=1)
    scene = prepare(spec, None, stages)
    points = lay_out(spec, scene, stages).points[::EVERY]
    positioner = _core.Positioner("exact", scene.model, scene.tool)
    placed = positioner.place(points, context=_core.Context(1))
    assert np.count_nonzero(placed["status"] == TWO_CONTACTS) >= len(points) - 2
    (face,) = file.read_part(f"resources/examples/{name}.step")
    patch = Patch(np.asarray(face.poles).reshape(4, 4, -1)[..., :3])
    tool = spec.tool
    for k, point in enumerate(points):
        at = (float(point[0]), float(point[1]))
        found = tilt_of(patch, at, SIDE_MM, tool.major_radius_mm, tool.minor_radius_mm, math.radians(45))
        assert placed["tilt_deg"][k] == pytest.approx(math.degrees(found.tilt), abs=TILT_DEG), at
        assert placed["contacts"][k, 0] == pytest.approx(found.contact, abs=1e-5), at
