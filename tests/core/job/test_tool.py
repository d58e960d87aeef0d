"""The shipped cutters."""

from __future__ import annotations

import pytest

from freecad_mpm.core.base import TOOLS, InputError
from freecad_mpm.core.job import tool as tools
from freecad_mpm.core.part.scene import native_tool

SHIPPED = sorted(path.stem for path in TOOLS.glob("*.toml"))


@pytest.mark.parametrize("name", SHIPPED)
def test_a_shipped_tool_is_whole(name: str) -> None:
    tool = tools.load(TOOLS / f"{name}.toml")
    assert tool.name and tool.shank and tool.holder
    native = native_tool(tool)
    assert native.radius == tool.radius_mm
    lengths = [one.length_mm for one in (*tool.shank, *tool.holder)]
    assert native.length == pytest.approx(tool.flute_length_mm + sum(lengths))


def test_the_thesis_tool_is_there() -> None:
    tool = tools.load(TOOLS / "thesis.toml")
    assert (tool.major_radius_mm, tool.minor_radius_mm, tool.recess_mm) == (6.7, 6.0, 6.0)


def test_segments_stand_on_the_flutes() -> None:
    """A point beside the holder is as far from the tool as from the holder's wall."""
    tool = tools.ToolSpec(
        5.0,
        1.0,
        flute_length_mm=10.0,
        holder=[{"bottom_radius_mm": 20.0, "top_radius_mm": 20.0, "length_mm": 30.0}],
    )
    distance = native_tool(tool).signed_distance((0, 0, 0), (0, 0, 1), [[27.0, 0, 25.0], [9.0, 0, 3.0]])
    assert distance.tolist() == pytest.approx([7.0, 3.0])


def test_a_missing_tool_file_is_named(tmp_path) -> None:
    with pytest.raises(InputError, match="nothing.toml: cannot be read"):
        tools.load(tmp_path / "nothing.toml")
