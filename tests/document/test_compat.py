"""What differs between FreeCAD's versions, on the version these tests run in."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import FreeCAD
import pytest

from freecad_mpm.document import compat


def quantity(value: float) -> Any:
    return FreeCAD.Units.Quantity(value, FreeCAD.Units.Length)


def bit(**values: Any) -> Any:
    return SimpleNamespace(
        Label="T", **{k: quantity(v) if isinstance(v, (int, float)) else v for k, v in values.items()}
    )


def test_flat_radius_is_the_radius_of_the_flat() -> None:
    assert compat.torus_of(bit(Diameter=12, FlatRadius=2)) == (6, 4)


def test_corner_radius_is_the_radius_of_the_corner() -> None:
    assert compat.torus_of(bit(Diameter=12, CornerRadius=2)) == (6, 2)


def test_a_ball_end_has_a_corner_as_large_as_itself() -> None:
    assert compat.torus_of(bit(Diameter=10, BitShape="/tools/ballend.fcstd")) == (5, 5)


@pytest.mark.parametrize("shape", ["endmill.fcstd", "C:\\tools\\v-bit.fcstd"])
def test_other_shapes_are_not_guessed(shape: str) -> None:
    with pytest.raises(ValueError, match="must be a bull nose or ball end, but its shape is '"):
        compat.torus_of(bit(Diameter=10, BitShape=shape))


def test_a_tool_of_the_old_table_is_not_guessed() -> None:
    with pytest.raises(ValueError, match="must be a tool bit"):
        compat.torus_of(SimpleNamespace(Diameter=5.0, CornerRadius=1.0))


def test_a_made_bull_nose_has_the_radii_asked_for(doc: Any) -> None:
    assert compat.torus_of(compat.make_bull_nose(doc, "Cutter", 12.7, 6.0)) == pytest.approx((12.7, 6.0))


def test_unknown_names_are_unknown() -> None:
    with pytest.raises(AttributeError, match="no attribute 'op_bases'"):
        compat.op_bases
