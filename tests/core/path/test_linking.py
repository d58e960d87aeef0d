"""Linking passes: the arrays that Python sees."""

import numpy as np
import pytest

from freecad_mpm import _core

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
TOOL = _core.Tool(6.7, 6.0, 6.0, 40.0, [(12.7, 12.7, 30.0)])


def floor(size=100.0):
    poles = np.array([[[0, 0, 0], [0, size, 0]], [[size, 0, 0], [size, size, 0]]], dtype=float)
    return _core.SurfaceModel([_core.Face("Face1", _core.BSplineSurface(1, 1, KNOTS, KNOTS, poles))])


def upright_raster(zigzag=False):
    points, passes = _core.raster(
        [20, 20], [80, 60], direction_deg=90, side_step_mm=20, forward_step_mm=4, zigzag=zigzag
    )
    tip = np.column_stack([points, np.zeros(len(points))])
    return tip, np.tile([0.0, 0.0, 1.0], (len(tip), 1)), passes


def link(tip, axis, passes, usable=None, **options):
    usable = np.ones(len(tip), bool) if usable is None else usable
    path = _core.link_passes(
        _core.CellTree(floor(), TOOL),
        TOOL,
        tip,
        axis,
        passes,
        usable,
        options=_core.LinkOptions(**options),
        context=_core.Context(),
    )
    return path | {"kind": np.array(_core.MOVE_KINDS)[path["kind"]]}


@pytest.mark.parametrize("zigzag", [False, True])
def test_every_position_is_visited_once_in_order(zigzag):
    tip, axis, passes = upright_raster(zigzag)
    path = link(tip, axis, passes)
    visited = path["position"] >= 0
    assert path["position"][visited].tolist() == list(range(len(tip)))
    assert np.array_equal(path["tip"][visited], tip)
    assert np.array_equal(path["pass_index"][visited], passes)
    assert set(path["kind"][visited]) == {"cut", "plunge"}
    assert not path["blocked"].any()
    assert path["proven"].tolist() == (path["kind"] != "cut").tolist()


def test_shapes_and_types():
    path = link(*upright_raster())
    count = len(path["kind"])
    assert path["tip"].shape == path["axis"].shape == (count, 3)
    assert path["clearance"].shape == path["blocked"].shape == path["pass_index"].shape == (count,)
    assert path["blocked"].dtype == path["proven"].dtype == bool and path["position"].dtype == np.int64


def test_zigzag_has_shorter_rapids():
    def rapid_length(path):
        steps = np.linalg.norm(np.diff(path["tip"], axis=0), axis=1)
        return steps[path["kind"][1:] == "rapid"].sum()

    assert rapid_length(link(*upright_raster(True))) < 0.6 * rapid_length(link(*upright_raster(False)))


def test_safe_plane_is_where_the_options_say():
    path = link(*upright_raster(), safe_clearance_mm=12.0)
    assert path["tip"][0, 2] == path["tip"][-1, 2] == 12.0
    assert path["kind"][0] == "rapid" and path["kind"][-1] == "retract"


def test_an_unusable_position_splits_its_pass():
    tip, axis, passes = upright_raster()
    usable = np.ones(len(tip), bool)
    usable[3] = False
    tip[3] = axis[3] = np.nan
    path = link(tip, axis, passes, usable)
    assert np.count_nonzero(path["kind"] == "plunge") == passes.max() + 2
    assert 3 not in path["position"]


def test_errors_name_the_argument():
    tip, axis, passes = upright_raster()
    with pytest.raises(ValueError, match="check_step_mm"):
        link(tip, axis, passes, check_step_mm=0.0)
    with pytest.raises(ValueError, match="axis: position 0"):
        link(tip, -axis, passes)
    with pytest.raises(ValueError, match="same length"):
        link(tip, axis[1:], passes)
