"""Certificates of moves through their Python door."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm import _core

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
TOOL = _core.Tool(6.7, 6.0, 6.0, 40.0, [])
UP = np.array([[0.0, 0.0, 1.0]])


def floor() -> _core.SurfaceModel:
    poles = np.array([[[0, 0, 0], [0, 100, 0]], [[100, 0, 0], [100, 100, 0]]], dtype=float)
    return _core.SurfaceModel([_core.Face("Face1", _core.BSplineSurface(1, 1, KNOTS, KNOTS, poles))])


def certify(
    tips: object,
    tips_to: object,
    axes: object = UP,
    axes_to: object = UP,
    threads: int = 0,
    **options: float,
) -> dict[str, np.ndarray]:
    return _core.certify_motions(
        _core.CellTree(floor(), TOOL),
        TOOL,
        tips,
        axes,
        tips_to,
        axes_to,
        **({"tolerance_mm": 0.01} | options),
        context=_core.Context(threads),
    )


@pytest.mark.parametrize(("depth", "verdict"), [(0.0, "free"), (0.009, "free"), (0.011, "gouge")])
def test_a_move_along_a_floor_is_as_deep_as_it_is(depth: float, verdict: str) -> None:
    found = certify([[40, 50, -depth]], [[43, 51, -depth]])
    assert _core.VERDICTS[found["verdict"][0]] == verdict
    if verdict == "free":
        assert -0.01 <= found["lo"][0] <= -depth + 1e-9
    else:
        assert -depth - 1e-9 <= found["hi"][0] < -0.01


def test_the_real_axis_may_be_off() -> None:
    free, unknown = (
        certify([[40, 50, 0.0]], [[43, 51, 0.0]], axis_deviation_deg=np.degrees(d)) for d in (3e-4, 3e-3)
    )
    assert _core.VERDICTS[free["verdict"][0]] == "free"
    assert _core.VERDICTS[unknown["verdict"][0]] == "undecided" and unknown["lo"][0] == -np.inf


def test_any_number_of_threads_certifies_the_same() -> None:
    random = np.random.default_rng(5)
    tips = random.uniform([20, 20, -0.02], [80, 80, 0.05], size=(40, 3))
    tips_to = tips + random.uniform(-2, 2, size=(40, 3)) * [1, 1, 0.003]
    axes = np.repeat(UP, 40, axis=0)
    one, two = (certify(tips, tips_to, axes, axes, threads=threads) for threads in (1, 2))
    assert all(np.array_equal(one[name], two[name]) for name in one)
    assert len(np.unique(one["verdict"])) > 1


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"tips_to": np.zeros((2, 3))}, "tips_to and axes_to must have the same shape"),
        ({"tips": [[np.nan, 0, 0]]}, "tips: motion 0"),
        ({"axes_to": 2 * UP}, "axes_to: motion 0"),
        ({"tolerance_mm": np.inf}, "tolerance_mm: motion 0 must be finite"),
        ({"tolerance_mm": np.zeros(2)}, "tolerance_mm must be a number or have shape"),
        ({"axis_deviation_deg": np.nan}, "axis_deviation_deg"),
    ],
)
def test_what_cannot_be_certified_is_named(change: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        certify(**({"tips": [[40, 50, 0]], "tips_to": [[43, 51, 0]]} | change))
