"""Programs: through FreeCAD's own Post Process command and through ours, read back by a reader of its own."""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any

import pytest
from parts import COARSE, TOP, free_form_block
from stock_post import post_process

import freecad_mpm
from freecad_mpm.core import machine
from freecad_mpm.core import posts as core_posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control.check import check_round_trip
from freecad_mpm.core.control.dialects import din_iso
from freecad_mpm.document import cl_path, compat, posts, program

TIP_MM, AXIS_DEG = 0.001, 0.001


@pytest.fixture
def job(op: Any) -> Any:
    return compat.job.Instances()[0]


def test_the_post_is_in_every_jobs_list(doc: Any, block: Any) -> None:
    posts.register()
    posts.register()
    assert "dmu80p" in compat.preferences.allAvailablePostProcessors()
    assert compat.preferences.searchPathsPost().count(posts.FOLDER) == 1
    job = compat.job.Create("Job", [block], None)
    assert "dmu80p" in job.getEnumerationsOfProperty("PostProcessor")


def test_every_post_of_the_core_is_in_the_list_and_writes_what_the_core_writes(op: Any) -> None:
    listed = compat.preferences.allAvailablePostProcessors()
    for name in core_posts.names():
        script = name if name == "dmu80p" else f"mpm_{name}"
        assert script in listed
        module = importlib.import_module(f"freecad_mpm.document.posts.{script}_post")
        assert module.export([op], "-", "") == program.program_text([op], name).text
        assert hasattr(module, script.title())  # the class that FreeCAD 1.0 looks for


def test_freecads_command_writes_what_ours_writes(op: Any, job: Any, tmp_path: Path) -> None:
    program.write(op, str(tmp_path / "ours.I"))
    assert post_process(job, tmp_path / "stock.I") == (tmp_path / "ours.I").read_bytes()


def test_the_program_takes_the_tool_where_the_path_does(op: Any, job: Any, tmp_path: Path) -> None:
    read = din_iso.read(post_process(job, tmp_path / "stock.I").decode("ascii"))
    moves = cl_path.from_commands(op.Path.Commands)
    trip = check_round_trip(read, machine.load(op.Machine), moves.tip, moves.axis)
    assert trip.findings == []
    assert trip.tip_error_mm <= TIP_MM and trip.axis_error_deg <= AXIS_DEG


def test_coolant_is_the_operations(op: Any) -> None:
    op.CoolantMode = "None"
    assert " M8 *" not in program.program_text([op], "dmu80p").text
    op.CoolantMode = "Flood"
    assert " M8 *" in program.program_text([op], "dmu80p").text


def test_two_operations_make_one_program(doc: Any, block: Any, op: Any, job: Any, tmp_path: Path) -> None:
    alone = len(post_process(job, tmp_path / "one.I"))
    freecad_mpm.create(doc, [(block, TOP)], Direction=0, **COARSE)
    assert len(post_process(job, tmp_path / "two.I")) > 1.5 * alone


def test_an_inactive_operation_is_left_out(doc: Any, block: Any, op: Any, job: Any, tmp_path: Path) -> None:
    alone = post_process(job, tmp_path / "one.I")
    freecad_mpm.create(doc, [(block, TOP)], Direction=0, **COARSE).Active = False
    doc.recompute()
    assert post_process(job, tmp_path / "two.I") == alone


def test_the_post_is_kept_in_the_document(op: Any, job: Any, tmp_path: Path) -> None:
    import FreeCAD

    name, file = job.Name, str(tmp_path / "part.FCStd")
    before = post_process(job, tmp_path / "before.I")
    op.Document.saveAs(file)
    FreeCAD.closeDocument(op.Document.Name)
    restored = FreeCAD.openDocument(file).getObject(name)
    assert restored.PostProcessor == "dmu80p"
    assert post_process(restored, tmp_path / "after.I") == before


def test_without_a_path_nothing_is_written(op: Any, tmp_path: Path) -> None:
    op.ForwardStep = 0
    op.Document.recompute()
    target = tmp_path / "program.I"
    target.write_text("the program of yesterday")
    with pytest.raises(InputError, match="MultiPointFinish: there is no up-to-date path: ForwardStep"):
        program.write(op, str(target))
    assert target.read_text() == "the program of yesterday"


def test_a_feed_of_zero_is_refused(op: Any, tmp_path: Path) -> None:
    op.ToolController.VertFeed = 0
    op.Document.recompute()
    with pytest.raises(InputError, match="the horizontal and vertical feed must be positive"):
        program.write(op, str(tmp_path / "program.I"))


def test_a_program_needs_one_of_our_operations(op: Any) -> None:
    module = pytest.importorskip("freecad_mpm.document.posts.dmu80p_post")
    foreign = op.Document.addObject("Path::FeaturePython", "Engrave")
    foreign.addProperty("App::PropertyLink", "ToolController")
    with pytest.raises(InputError, match="there is no active Multi-Point Finish operation"):
        module.export([foreign], "-", "")


def test_two_tools_are_two_tool_calls(doc: Any, block: Any, op: Any) -> None:
    other = freecad_mpm.create(doc, [(block, TOP)], major_radius_mm=3, minor_radius_mm=1, **COARSE)
    other.ToolController.ToolNumber = 7
    result = program.program_text([op, other], "tnc_klartext")
    numbers = [int(line.split()[3]) for line in result.text.split("\r\n") if " TOOL CALL " in line]
    assert numbers == [op.ToolController.ToolNumber, 7] and result.warnings == []


def test_an_unwritable_folder_is_named(op: Any) -> None:
    with pytest.raises(InputError, match="/proc"):
        program.write(op, "/proc/program.I")


def test_a_plan_that_is_not_good_is_written_with_a_warning(doc: Any) -> None:
    block = free_form_block(doc)
    op = freecad_mpm.create(doc, [(block, TOP)], **COARSE)
    op.Good, op.Verdict = False, "NOT GOOD: 3 positions cut in deeper than 0.001 mm"
    assert program.program_text([op], "dmu80p").warnings[0] == f"{op.Label}: {op.Verdict}"
