"""The solid of the tool: on the native tool's skin, closed, and of the volume that Pappus gives."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm.core.base import TOOLS
from freecad_mpm.core.job import Segment, ToolSpec
from freecad_mpm.core.job import tool as tools
from freecad_mpm.core.part.scene import native_tool
from freecad_mpm.core.playback import tool_solid

SHIPPED = sorted(TOOLS.glob("*.toml"))
SPECIAL = {
    "ball": ToolSpec(0.0, 5.0),
    "flat": ToolSpec(8.0, 0.0),
    "ring that crosses the axis": ToolSpec(2.0, 6.0, 6.0, 30.0),
    "hollow that ends in the ring": ToolSpec(5.0, 6.0, 1.0, 30.0),
    "cone": ToolSpec(6.7, 6.0, 3.0, 40.0, (Segment(10.0, 14.0, 30.0),), (Segment(20.0, 25.0, 10.0),)),
}
TOOL = {path.stem: tools.load(path) for path in SHIPPED} | SPECIAL


@pytest.mark.parametrize("name", TOOL)
def test_the_outline_lies_on_the_native_tools_skin(name: str) -> None:
    points = np.concatenate([one.points for one in tool_solid.outlines(TOOL[name])])
    outside = np.column_stack((points[:, 0], np.zeros(len(points)), points[:, 1]))
    distance = native_tool(TOOL[name]).signed_distance([0, 0, 0], [0, 0, 1], outside)
    assert np.abs(distance).max() < 1e-9


def volume(mesh: tool_solid.Mesh) -> float:
    """Of the cones from the origin over all triangles; right for a closed surface."""
    return float(np.linalg.det(mesh.corners).sum() / 6)


def whole(tool: ToolSpec, facets: int = tool_solid.FACETS) -> tool_solid.Mesh:
    points = np.concatenate([one.points for one in tool_solid.outlines(tool)])
    return tool_solid.revolved(points, facets)


@pytest.mark.parametrize("name", TOOL)
def test_the_pieces_together_are_closed(name: str) -> None:
    corners = np.concatenate([mesh.corners for mesh in tool_solid.meshes(TOOL[name]).values()])
    _, node = np.unique(corners.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    triangles = node.reshape(-1, 3)
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)])
    assert (edges[:, 0] != edges[:, 1]).all()
    assert {tuple(edge) for edge in edges} == {tuple(edge) for edge in edges[:, ::-1]}
    assert len({tuple(edge) for edge in edges}) == len(edges)


def test_volume_of_a_bull_nose_by_pappus() -> None:
    major, minor, flute = 7.5, 5.0, 40.0
    quarter = np.pi * minor**2 / 4 * (major + 4 * minor / (3 * np.pi))  # area times radius of its centroid
    exact = np.pi * major**2 * minor + 2 * np.pi * quarter + np.pi * (major + minor) ** 2 * (flute - minor)
    assert volume(whole(ToolSpec(major, minor, 0.0, flute), 400)) == pytest.approx(exact, rel=2e-3)


def test_a_hollow_takes_its_volume_away() -> None:
    major, minor = 6.7, 6.0
    filled, hollow = (volume(whole(ToolSpec(major, minor, depth, 40.0), 400)) for depth in (0.0, minor))
    # A disc of radius Ro and height Ri, less the inner lower quarter of the ring that stays.
    quarter = np.pi * minor**2 / 4 * (major - 4 * minor / (3 * np.pi))
    assert filled - hollow == pytest.approx(np.pi * major**2 * minor - 2 * np.pi * quarter, rel=1e-2)


def test_length_and_reach() -> None:
    tool = TOOL["thesis"]
    native = native_tool(tool)
    assert tool_solid.length_mm(tool) == native.length
    assert tool_solid.reach_mm(tool) == native.reach
