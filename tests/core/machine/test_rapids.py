"""Rapids are proven as the machine's joints run, not as the great circle would have it."""

from types import SimpleNamespace

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core import machine as machines
from freecad_mpm.core.base import MACHINES, Stages
from freecad_mpm.core.job import PostSpec
from freecad_mpm.core.machine import joint_path, with_rapids_proven
from freecad_mpm.core.path import ToolPath

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
TOOL = _core.Tool(6.7, 6.0, 6.0, 60.0, [])
TILT = np.radians(30.0)


def wall(y, height=60.0):
    """Upright, along x, from z = 0 up."""
    poles = np.array([[[-99, y, 0], [-99, y, height]], [[99, y, 0], [99, y, height]]], dtype=float)
    return _core.Face(f"at {y}", _core.BSplineSurface(1, 1, KNOTS, KNOTS, poles))


def turning_rapid(walls, tcp=True, height=0.0):
    """The tool leans to +x, then to -x, its tip at the same place: a table C turns by half a turn for that."""
    machine = machines.load(MACHINES / "dmu80p.toml")
    model = _core.SurfaceModel(walls)
    tip = np.array([[0, 0, height], [0, 0, height], [0, 0, height + 9.0]], dtype=float)
    axis = np.array([[s * np.sin(TILT), 0, np.cos(TILT)] for s in (1, -1, -1)])
    kind = np.array(["rapid", "rapid", "retract"])
    joints = joint_path(
        machine,
        kind,
        tip,
        axis,
        np.ones(3),
        axis_tolerance_deg=0.01,
        tip_tolerance_mm=None if tcp else 0.01,
    )
    path = ToolPath(
        kind, tip, axis, *np.zeros((3, 3)), np.zeros(3, dtype=bool), np.array([False, False, True])
    )
    found = with_rapids_proven(
        SimpleNamespace(post=PostSpec(tcp=tcp)),
        machine,
        SimpleNamespace(cells=_core.CellTree(model, TOOL), tool=TOOL),
        path,
        joints,
        Stages(),
    )
    return found.proven.tolist()


def great_circle_is_free(walls):
    poses = [[[0.0, 0.0, 0.0]], [[np.sin(TILT), 0, np.cos(TILT)]]]
    to = [[[0.0, 0.0, 0.0]], [[-np.sin(TILT), 0, np.cos(TILT)]]]
    cells = _core.CellTree(_core.SurfaceModel(walls), TOOL)
    found = _core.certify_motions(cells, TOOL, *poses, *to, tolerance_mm=0.0, context=_core.Context())
    return _core.VERDICTS[found["verdict"][0]] == "free"


@pytest.mark.parametrize("tcp", [True, False])
def test_a_turn_in_the_open_is_proven(tcp):
    assert turning_rapid([wall(60.0), wall(-60.0)], tcp) == [True, True, True]


def test_a_table_that_swings_the_tool_into_a_wall_is_not():
    walls = [wall(25.0), wall(-25.0)]  # the tool reaches 41 mm to the side where it leans
    assert great_circle_is_free(walls)
    assert turning_rapid(walls) == [True, False, True]
    assert turning_rapid(walls, height=60.0) == [True, True, True]  # above them


def test_only_the_machines_rapids_are_judged():
    """The retract through the wall is another's to prove: it keeps what it has."""
    assert turning_rapid([wall(60.0), wall(9.0)])[2]
