"""CAM's own three-axis operations before ours in one Job, through CAM's Post Process command."""

from __future__ import annotations

import importlib
import math
import re
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np
import Path as CamPath
import pytest
from parts import COARSE, TOP
from stock_post import post_process

import freecad_mpm
from freecad_mpm.core import machine, posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control import Control, check_program, dialects
from freecad_mpm.document import compat, program, three_axis
from freecad_mpm.document.post_arguments import parse
from freecad_mpm.document.posts import register

HEIGHTS = {"StartDepth": 0.0, "FinalDepth": -3.0, "StepDown": 1.0, "SafeHeight": 8.0, "ClearanceHeight": 12.0}


@pytest.fixture
def op(doc: Any, block: Any) -> Any:
    """Our operation in a Job whose model also has a plain box beside the block."""
    box = doc.addObject("Part::Box", "Box")
    box.Length, box.Width, box.Height = 30, 24, 12
    box.Placement.Base = FreeCAD.Vector(70, 5, -12)
    doc.recompute()
    register()
    job = compat.job.Create("Job", [block, box], None)
    return freecad_mpm.create(doc, [(block, TOP)], job=job, **COARSE)


@pytest.fixture
def job(op: Any) -> Any:
    return compat.job.Instances()[0]


@pytest.fixture
def pocket(doc: Any, op: Any, job: Any) -> Any:
    """CAM's own pocket in the box, with an end mill of its own, before our operation."""
    flat = "PathScripts.PathPocketShape" if compat.FLAT_MODULES else "Path.Op.PocketShape"
    controller = end_mill(job)
    with compat.chosen(job, controller):
        made = importlib.import_module(flat).Create("Pocket", parentJob=job)
    made.ToolController = controller
    box = max(job.Model.Group, key=lambda one: one.Shape.BoundBox.XMin)
    made.Base = [(box, ["Face6"])]
    for name, value in HEIGHTS.items():
        made.setExpression(name, None)
        setattr(made, name, value)
    operations = job.Operations.Group
    job.Operations.Group = [made, *(one for one in operations if one is not made)]
    doc.recompute()
    assert len(made.Path.Commands) > 20
    return made


def end_mill(job: Any) -> Any:
    controller = compat.controller.Create("EndMill")
    controller.ToolNumber = 5
    controller.HorizFeed, controller.VertFeed = "900 mm/min", "200 mm/min"
    controller.SpindleSpeed = 4000
    job.Proxy.addToolController(controller)
    return controller


def expected(*ops: Any) -> tuple[np.ndarray, np.ndarray]:
    """Tips and axes of the operations, from their paths."""
    from freecad_mpm.document import cl_path

    tips, axes = [], []
    for op in ops:
        ours = hasattr(op, "Verdict")
        moves = (
            cl_path.from_commands(op.Path.Commands)
            if ours
            else three_axis.moves_of(op.Label, op.Path.Commands)
        )
        tips.append(moves.tip)
        axes.append(moves.axis)
    return np.vstack(tips), np.vstack(axes)


@pytest.mark.parametrize("arguments", ["", "--no-tcp --no-comments"])
def test_a_pocket_and_our_finishing_make_one_program(
    op: Any, job: Any, pocket: Any, tmp_path: Path, arguments: str
) -> None:
    """Of every post, through CAM's own command."""
    tcp = "--no-tcp" not in arguments
    job.PostProcessorArgs = arguments
    for name in posts.names():
        if tcp or posts.load(name).joints:
            job.PostProcessor = name if name == "dmu80p" else f"mpm_{name}"
            text = post_process(job, tmp_path / f"{name}.nc").decode("ascii")
            assert_one_program(text, name, (pocket, op), Control(tcp, between_mm=0.0026))


def assert_one_program(text: str, name: str, ops: tuple[Any, Any], control: Control) -> None:
    read = dialects.read(text, posts.load(name).dialect)
    result = check_program(read, machine.load(ops[1].Machine), *expected(*ops), control)
    assert result.findings == [], name
    assert result.tip_error_mm < 0.0005 and result.axis_error_deg < 0.0005
    tools = [block.words["T"] for block in read.blocks if "T" in block.words]
    assert tools == [5, ops[1].ToolController.ToolNumber]


def test_the_pockets_feeds_and_speed_are_its_controllers(op: Any, pocket: Any) -> None:
    text = program.program_text([pocket, op], "tnc_klartext").text
    first = text[: text.index("TOOL CALL", text.index("TOOL CALL") + 1)]
    assert "TOOL CALL 5 Z S4000" in first
    assert {float(f) for f in re.findall(r"F(\d+)", first)} == {900.0, 200.0}


def test_an_inactive_pocket_is_left_out(op: Any, job: Any, pocket: Any, tmp_path: Path) -> None:
    job.PostProcessor, pocket.Active = "dmu80p", False
    op.Document.recompute()
    assert post_process(job, tmp_path / "p.I").decode().count(" G17 S") == 1


COMMANDS = [("G0", dict(Z=10.0)), ("G0", dict(X=5.0, Y=0.0))]


def moves_of(*commands: tuple[str, dict[str, float]]) -> three_axis.UprightMoves:
    return three_axis.moves_of("Op", [CamPath.Command(name, words) for name, words in (*COMMANDS, *commands)])


def test_moves_begin_where_the_place_is_known() -> None:
    moves = moves_of(("G1", dict(Z=1.0, F=10.0)), ("G1", dict(X=9.0)))
    assert moves.kind.tolist() == ["rapid", "cut", "cut"]
    assert moves.tip.tolist() == [[5, 0, 10], [5, 0, 1], [9, 0, 1]]
    assert moves.feed_mm_per_min.tolist()[1:] == [600.0, 600.0]


@pytest.mark.parametrize("name, side", [("G2", -1.0), ("G3", 1.0)])
def test_a_quarter_circle_keeps_its_radius_and_side(name: str, side: float) -> None:
    moves = moves_of(("G1", dict(Z=1.0, F=10.0)), (name, dict(X=0.0, Y=5.0 * side, Z=2.0, I=-5.0, J=0.0)))
    arc = moves.tip[1:]
    assert arc[-1] == pytest.approx([0.0, 5.0 * side, 2.0])
    assert np.abs(np.hypot(arc[:, 0], arc[:, 1]) - 5.0).max() < 1e-9
    middle = 0.5 * (arc[1:, :2] + arc[:-1, :2])
    sagitta = 5.0 - np.linalg.norm(middle, axis=1)
    assert 0 < sagitta.max() <= three_axis.ARC_TOLERANCE_MM
    assert (np.diff(arc[:, 2]) > 0).all() and (side * arc[1:, 1] > 0).all()


def test_an_arc_back_to_its_start_is_a_full_turn() -> None:
    moves = moves_of(("G1", dict(Z=1.0, F=10.0)), ("G2", dict(X=5.0, Y=0.0, I=-5.0, J=0.0)))
    way = np.linalg.norm(np.diff(moves.tip[1:], axis=0), axis=1).sum()
    assert way == pytest.approx(2 * math.pi * 5.0, rel=1e-3)


def test_drilling_cycles_go_down_and_come_back() -> None:
    moves = moves_of(
        ("G81", dict(X=1.0, Y=2.0, Z=-4.0, R=3.0, F=2.0)), ("G83", dict(X=8.0, Y=2.0, Z=-3.0, R=3.0, Q=2.0))
    )
    cuts = moves.tip[moves.kind == "cut"].tolist()
    assert cuts == [[1, 2, -4], [8, 2, 1], [8, 2, -1], [8, 2, -3]]
    assert moves.tip[-1].tolist() == [8, 2, 3]


@pytest.mark.parametrize(
    "command, told",
    [
        (("G76", {}), "Op: G76 cannot be written"),
        (("G1", dict(X=1.0, A=3.0, F=1.0)), "Op: G1 turns a rotary axis"),
        (("G1", dict(X=1.0)), "Op: the feeds of its tool controller must be positive"),
        (("G83", dict(X=1.0, Y=1.0, Z=0.0, R=1.0, F=1.0)), "Op: a peck cycle needs a step Q"),
    ],
)
def test_what_cannot_be_written_is_told(command: tuple[str, dict[str, float]], told: str) -> None:
    with pytest.raises(InputError, match=told):
        moves_of(command)


def test_arguments_in_freecads_words() -> None:
    given = parse(
        "--no-show-editor --precision=3 --axis-precision 5 --no-comments --no-tcp --path-tolerance 0.02"
    )
    assert not given.tcp
    assert given.options == {"decimals": 5, "comments": False, "path_tolerance_mm": 0.02}
    assert parse("").options == {} and parse("").tcp


@pytest.mark.parametrize(
    "text, told",
    [
        ("--colour", "unrecognized arguments: --colour; there are --no-comments"),
        ("--inches", "millimetres only"),
        ("--precision x", "invalid int value"),
    ],
)
def test_wrong_arguments_are_told(text: str, told: str) -> None:
    with pytest.raises(InputError, match=told):
        parse(text)


def test_an_argument_that_the_post_has_no_use_for_is_told(op: Any) -> None:
    with pytest.raises(InputError, match="program_number: the post tnc_klartext has no use for it"):
        program.program_text([op], "tnc_klartext", "--program-number 7")
    assert "O0007 " in program.program_text([op], "fanuc", "--program-number 7").text
