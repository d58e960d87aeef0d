"""freecad_mpm.create from a script: with and without a job, and what wrong arguments get."""

from __future__ import annotations

import math
from typing import Any

import pytest
from parts import COARSE, TOP, free_form_block

import freecad_mpm
from freecad_mpm.core.base import Cancelled, InputError
from freecad_mpm.document import cl_path, compat, hooks


def test_without_a_job_one_is_made_with_a_bull_nose(doc: Any, block: Any) -> None:
    op = freecad_mpm.create(doc, [(block, TOP)], major_radius_mm=4, minor_radius_mm=2, **COARSE)
    (job,) = compat.job.Instances()
    assert op in job.Operations.Group
    assert [controller.ToolNumber for controller in job.Tools.Group] == [1]
    assert compat.torus_of(op.ToolController.Tool) == pytest.approx((6, 2))
    assert op.ToolController.HorizFeed.Value * 60 == pytest.approx(1000)
    assert job.PostProcessor == "dmu80p"


def test_the_tool_made_without_asking_is_the_shipped_hollow_one(doc: Any, block: Any) -> None:
    from freecad_mpm.core.base import TOOLS
    from freecad_mpm.core.job import tool
    from freecad_mpm.document.job_spec import tool_of

    op = freecad_mpm.create(doc, [(block, TOP)], **COARSE)
    shipped, ours = tool.load(TOOLS / "thesis.toml"), tool_of(op)
    for name in ("major_radius_mm", "minor_radius_mm", "recess_mm", "flute_length_mm", "shank"):
        assert getattr(ours, name) == pytest.approx(getattr(shipped, name)), name


def test_the_shank_of_the_tool_is_kept_clear_too(op: Any) -> None:
    from freecad_mpm.document.job_spec import tool_of

    bit = op.ToolController.Tool
    bit.CuttingEdgeHeight, bit.Length, bit.ShankDiameter = 20, 50, 18
    (shank,) = tool_of(op).shank
    assert (shank.bottom_radius_mm, shank.top_radius_mm, shank.length_mm) == (9, 9, 30)


def test_the_path_covers_the_picked_face_and_ends_clear_of_the_part(op: Any, block: Any) -> None:
    moves = cl_path.from_commands(op.Path.Commands)
    box, cuts = block.Shape.BoundBox, [kind == "cut" for kind in moves.kind]
    assert sum(cuts) > 20
    assert moves.tip[cuts][:, 1].min() < box.YMin + 12 and moves.tip[cuts][:, 1].max() > box.YMax - 12
    assert min(moves.tip[0, 2], moves.tip[-1, 2]) > box.ZMax
    assert moves.axis[:, 2].min() > 0.5


def test_results_are_filled_in(op: Any) -> None:
    assert op.Problem == ""
    assert op.Positions > 20
    assert sum(int(line.split(": ")[1]) for line in op.Statuses) == op.Positions
    assert op.Report.startswith(f"Verdict: {op.Verdict}")
    assert len(op.MoveStatus) == len(cl_path.from_commands(op.Path.Commands))
    assert op.FirstContacts


def test_contacts_lie_on_the_faces(op: Any, block: Any) -> None:
    import Part

    for contact in [*op.FirstContacts[:5], *op.SecondContacts[:5]]:
        assert block.Shape.distToShape(Part.Vertex(contact))[0] < 0.01


def test_cut_feed_is_the_controllers(op: Any) -> None:
    op.ToolController.HorizFeed = "720 mm/min"
    op.Document.recompute()
    moves = cl_path.from_commands(op.Path.Commands)
    assert {round(feed) for kind, feed in zip(moves.kind, moves.feed_mm_per_min) if kind == "cut"} == {720}
    assert {feed for kind, feed in zip(moves.kind, moves.feed_mm_per_min) if kind == "rapid"} == {0}


def test_a_second_operation_goes_into_the_same_job_and_uses_its_tool(doc: Any, block: Any, op: Any) -> None:
    second = freecad_mpm.create(doc, [(block, TOP)], Direction="0 deg", **COARSE)
    (job,) = compat.job.Instances()
    assert job.Operations.Group == [op, second]
    assert second.ToolController == op.ToolController


def test_other_radii_give_the_job_a_second_tool(doc: Any, block: Any, op: Any) -> None:
    second = freecad_mpm.create(doc, [(block, TOP)], major_radius_mm=3, minor_radius_mm=1, **COARSE)
    assert second.ToolController != op.ToolController
    assert second.ToolController.ToolNumber == 2
    assert compat.torus_of(second.ToolController.Tool) == pytest.approx((4, 1))


def test_a_job_of_other_parts_is_left_alone(doc: Any, block: Any, op: Any) -> None:
    other = free_form_block(doc, "Other")
    second = freecad_mpm.create(doc, [(other, TOP)], **COARSE)
    assert len(compat.job.Instances()) == 2
    assert second not in op.getParentGroup().Group


def test_faces_may_be_picked_on_the_jobs_own_model(doc: Any, op: Any) -> None:
    model, names = op.Base[0]
    assert freecad_mpm.create(doc, [(model, names)], **COARSE).Base == op.Base


def test_all_other_faces_are_kept_clear(doc: Any, block: Any, op: Any) -> None:
    from freecad_mpm.document.model import model_faces

    (job,) = compat.job.Instances()
    found = model_faces(job, op.Base, 0.01)
    assert found.machined == [f"{op.Base[0][0].Name}.{TOP}"]
    assert len(found.check) == len(block.Shape.Faces) - 1


def test_properties_take_units(doc: Any, block: Any) -> None:
    op = freecad_mpm.create(
        doc, [(block, TOP)], SideStep="1/2 in", ForwardStep=8.0, TiltMax="0.5 rad", ZigZag=True
    )
    assert op.SideStep.Value == pytest.approx(12.7)
    assert op.TiltMax.Value == pytest.approx(math.degrees(0.5))


def test_a_change_recomputes(op: Any) -> None:
    before = op.Positions
    op.SideStep = "30 mm"
    op.Document.recompute()
    assert 0 < op.Positions < before


def test_a_model_in_a_moved_part_is_machined_where_it_stands(doc: Any, block: Any) -> None:
    import FreeCAD

    holder = doc.addObject("App::Part", "Holder")
    holder.Placement.Base = FreeCAD.Vector(200, 0, 50)
    holder.addObject(block)
    doc.recompute()
    op = freecad_mpm.create(doc, [(block, TOP)], **COARSE)
    assert cl_path.from_commands(op.Path.Commands).tip[:, 0].min() > 150


def test_a_face_of_a_bodys_feature_is_machined_on_the_body(doc: Any) -> None:
    body = doc.addObject("PartDesign::Body", "Body")
    box = doc.addObject("PartDesign::AdditiveBox", "Box")
    box.Length, box.Width, box.Height = 60, 40, 15
    body.addObject(box)
    doc.recompute()
    top = next(f"Face{i}" for i, face in enumerate(box.Shape.Faces, 1) if face.CenterOfMass.z > 14)
    op = freecad_mpm.create(doc, [(box, top)], **COARSE)
    (job,) = compat.job.Instances()
    assert job.Proxy.baseObject(job, op.Base[0][0]) == body
    assert op.Positions > 20


WRONG_FACES = {
    "no face is picked": [],
    "pick faces, not Edge1": ["Edge1"],
    "there is no Face99; it has 6 faces": ["Face99"],
    "pick faces, not the whole object": [""],
}


@pytest.mark.parametrize("message", WRONG_FACES)
def test_wrong_faces_are_refused_before_anything_is_made(doc: Any, block: Any, message: str) -> None:
    with pytest.raises(InputError, match=message):
        freecad_mpm.create(doc, [(block, name) for name in WRONG_FACES[message]])
    assert doc.Objects == [block]


WRONG_VALUES = [
    ("SideStep", "0 mm", "SideStep: must be a positive number of mm, got 0.0"),
    ("SideStep", "tea", "SideStep: must be a length"),
    ("SideSteps", 5, "SideSteps: no such property; there are Method, "),
    ("Method", "magic", "Method: must be one of .*vcrf"),
    ("Machine", "toaster", "Machine: must be one of "),
    ("TiltMax", "95 deg", "TiltMax: must be "),
    ("SideStep", "0.000001 mm", "^SideStep, ForwardStep: "),
]


@pytest.mark.parametrize("name, value, message", WRONG_VALUES)
def test_wrong_values_are_refused_by_name(doc: Any, block: Any, name: str, value: Any, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        freecad_mpm.create(doc, [(block, TOP)], **{name: value})
    assert "\n" not in str(caught.value)


def test_a_negative_radius_is_refused(doc: Any, block: Any) -> None:
    with pytest.raises(InputError, match="minor_radius_mm: must be zero or a positive number of mm"):
        freecad_mpm.create(doc, [(block, TOP)], major_radius_mm=4, minor_radius_mm=-1)


def test_an_unusable_tool_is_refused(doc: Any, block: Any, op: Any) -> None:
    op.ToolController = compat.controller.Create("TC: end mill", toolNumber=9)
    compat.job.Instances()[0].Proxy.addToolController(op.ToolController)
    doc.recompute()
    assert op.Problem.startswith("tool '")
    assert "must be a bull nose or ball end" in op.Problem
    assert op.Path.Size <= 2  # CAM's own comment lines


def test_cancelling_leaves_no_path_and_says_so(op: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hooks, "run", lambda call: call(on_progress=None, cancel=lambda: True))
    op.SideStep = "10 mm"
    op.Document.recompute()
    assert op.Problem == "cancelled"
    assert op.Positions == 0 and len(cl_path.from_commands(op.Path.Commands)) == 0


def test_cancelled_creation_raises_cancelled(doc: Any, block: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hooks, "run", lambda call: call(on_progress=None, cancel=lambda: True))
    with pytest.raises(Cancelled):
        freecad_mpm.create(doc, [(block, TOP)])


def test_after_a_failure_the_next_recompute_can_succeed(op: Any) -> None:
    op.ForwardStep = 0
    op.Document.recompute()
    assert op.Problem.startswith("ForwardStep")
    op.ForwardStep = "6 mm"
    op.Document.recompute()
    assert op.Problem == "" and op.Positions > 20


def test_undo_takes_everything_back(doc: Any, block: Any) -> None:
    doc.UndoMode = 1
    doc.openTransaction("Multi-Point Finish")
    freecad_mpm.create(doc, [(block, TOP)], **COARSE)
    doc.commitTransaction()
    assert len(doc.Objects) > 5
    doc.undo()
    assert doc.Objects == [block]
    doc.redo()
    op = next(obj for obj in doc.Objects if obj.Name.startswith("MultiPointFinish"))
    assert op.Positions > 20 and len(cl_path.from_commands(op.Path.Commands)) > 20


def test_a_contact_spacing_is_kept_by_spin(doc: Any, block: Any) -> None:
    op = freecad_mpm.create(doc, [(block, TOP)], ContactSpacing="6 mm", SpacingMeasure="direct", **COARSE)
    assert op.Problem == "" and op.Good
    assert "Contacts 6 mm apart from contact to contact: within 1% at" in op.Report
    op.Spin = "10 deg"
    doc.recompute()
    assert op.Problem == "Spin: must be 0 when a contact spacing chooses the spin, got 10"


def test_a_method_that_cannot_spin_refuses_a_contact_spacing(doc: Any, block: Any) -> None:
    with pytest.raises(InputError, match="ContactSpacing: must be 0 for vcrf, which cannot spin"):
        freecad_mpm.create(doc, [(block, TOP)], Method="vcrf", ContactSpacing="6 mm", **COARSE)
