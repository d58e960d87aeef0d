"""Planes as the command line takes them."""

from __future__ import annotations

import pytest

from freecad_mpm.core.base import InputError
from freecad_mpm.core.removal import planes


@pytest.mark.parametrize(
    ("text", "name", "origin", "normal"),
    [
        ("y=27", "y27", (0, 27, 0), (0, 1, 0)),
        ("z=-4.5", "z-4.5", (0, 0, -4.5), (0, 0, 1)),
        ("line=10,20:40,20", "line_10_20_40_20", (10, 20, 0), (0, 30, 0)),
        ("point=1,2,3:normal=0,1,1", "plane_1_2_3_0_1_1", (1, 2, 3), (0, 1, 1)),
    ],
)
def test_what_the_command_line_takes(text: str, name: str, origin: object, normal: object) -> None:
    found = planes.parse(text)
    assert (found.name, found.origin, found.normal) == (name, origin, normal)


@pytest.mark.parametrize(
    "text",
    ["", "w=3", "x=", "x=1,2", "y=nan", "line=1,2", "line=1,2:3", "point=1,2,3", "point=1,2,3:1,1,1", "xy=3"],
)
def test_what_it_does_not_take(text: str) -> None:
    with pytest.raises(InputError, match="--section: must be x=MM, .* or point=X,Y,Z:normal=X,Y,Z, got"):
        planes.parse(text)


@pytest.mark.parametrize("text", ["line=1,2:1,2", "point=1,2,3:normal=0,0,0"])
def test_a_plane_without_direction(text: str) -> None:
    with pytest.raises(InputError, match="its points must differ, its normal must not be 0"):
        planes.parse(text)
