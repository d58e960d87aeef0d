"""The whole way in a real window, with a real mouse: pick, compute, look, undo, save, edit, post."""

from __future__ import annotations

from pathlib import Path

from freecad_window import FreeCADWindow
from window_words import COARSE, TOP_MIDDLE, dialog_text, press, press_cancel, press_in_panel

FINISHED = "op = doc.getObject('MultiPointFinish')\nresult = op is not None and not doc.HasPendingTransaction"
PICKED = "[[s.ObjectName, *s.SubElementNames] for s in Gui.Selection.getSelectionEx()]"
DRAWN = """
nodes = op.ViewObject.Proxy.nodes
result = dict(cuts=nodes.cuts.count, links=nodes.links.count, axes=nodes.axes.count,
              first=nodes.first.count, second=nodes.second.count)
"""
# Pixels of the 3D view in one of our colours; a picture of the view shows no selection.
PIXELS = """
def pixels(view, color):
    file = os.path.join(FreeCAD.getTempPath(), "view.png")
    view.saveImage(file, 800, 600, "White")
    image = QtGui.QImage(file)
    near = lambda a, b: abs(a - round(255 * b)) <= 8
    points = (QtGui.QColor(image.pixel(x, y)) for x in range(0, 800) for y in range(0, 600))
    return sum(near(p.red(), color[0]) and near(p.green(), color[1]) and near(p.blue(), color[2]) for p in points)
from freecad_mpm.gui import toolpath_nodes
CUT, AXIS, CONTACT = (toolpath_nodes.CUT_COLORS["two_contacts"], toolpath_nodes.AXIS_COLOR,
                      toolpath_nodes.FIRST_CONTACT_COLOR)
"""


def click_top_face(window: FreeCADWindow) -> None:
    window.click(TOP_MIDDLE, hovered="top in Gui.Selection.getPreselection().SubElementNames")
    window.wait_for(f"{PICKED} == [['Block', top]]", "the top face to be picked")


def finish(window: FreeCADWindow) -> None:
    """The command's button, until there is an operation, `op`."""
    press(window, "MPM_Finish")
    window.wait_for(lambda: window.run(FINISHED), "the finished operation")


def test_a_click_on_a_face_and_the_command_make_an_operation(window: FreeCADWindow, part: None) -> None:
    click_top_face(window)
    window.screenshot("1-face-picked")
    finish(window)
    assert window.run("result = op.Problem") == ""
    assert window.run("result = op.Positions") > 100
    assert window.run(
        "result = [job.Operations.Group == [op] for job in doc.Objects if job.Name == 'Job']"
    ) == [True]
    drawn = window.run(DRAWN)
    assert min(drawn.values()) > 100
    window.run("unfold(op)")
    window.screenshot("3-properties")
    window.run("Gui.Selection.clearSelection()")
    window.screenshot("2-operation")


def test_passes_axes_and_contacts_are_seen(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + PIXELS + "view.fitAll()")
    count = "result = [pixels(view, color) for color in (CUT, AXIS, CONTACT)]"
    assert min(window.run(count)) > 20
    assert window.run("op.ViewObject.Visibility = False\n" + count) == [0, 0, 0]


def test_undo_takes_the_operation_and_its_job_away_and_redo_brings_them_back(
    window: FreeCADWindow, part: None
) -> None:
    click_top_face(window)
    finish(window)
    before = window.run(DRAWN)
    assert window.run("result = doc.UndoNames") == ["Multi-Point Finish"]
    assert window.run("doc.undo()\nresult = [obj.Name for obj in doc.Objects]") == ["Block"]
    assert window.run("doc.redo()\nop = doc.getObject('MultiPointFinish')\n" + DRAWN) == before


def test_a_reopened_document_shows_the_path_without_computing(
    window: FreeCADWindow, part: None, tmp_path: Path
) -> None:
    before = window.run(COARSE + DRAWN)
    window.run(f"doc.saveAs({str(tmp_path / 'part.FCStd')!r})\nFreeCAD.closeDocument(doc.Name)")
    window.run(
        "from freecad_mpm.document import computation\n"
        "real, computation.compute = computation.compute, None\n"
        f"doc = FreeCAD.openDocument({str(tmp_path / 'part.FCStd')!r})\n"
        "idle()\n"
        "op = doc.getObject('MultiPointFinish')\n"
        "computation.compute = real"
    )
    assert window.run(DRAWN) == before
    assert window.run("result = type(op.ViewObject.Proxy).__name__") == "MultiPointFinishViewProvider"
    window.run(PIXELS + "view = Gui.ActiveDocument.ActiveView\nview.fitAll()")
    assert window.run("result = pixels(view, CUT)") > 20


def test_without_a_picked_face_the_user_is_told(window: FreeCADWindow, part: None) -> None:
    window.run("Gui.Selection.clearSelection()")
    press(window, "MPM_Finish")
    assert dialog_text(window) == "no face is picked: pick one or more faces of the part first"
    assert window.run("result = [obj.Name for obj in doc.Objects]") == ["Block"]


def test_a_picked_edge_is_refused(window: FreeCADWindow, part: None) -> None:
    window.run("Gui.Selection.clearSelection()\nGui.Selection.addSelection(block, 'Edge1')")
    press(window, "MPM_Finish")
    assert dialog_text(window) == "'Block': pick faces, not Edge1"
    assert window.run("result = [obj.Name for obj in doc.Objects]") == ["Block"]


def test_cancel_in_the_progress_dialog_leaves_nothing(window: FreeCADWindow, part: None) -> None:
    window.run(
        "from freecad_mpm.document import properties\n"
        "from dataclasses import replace\n"
        "fine = tuple(replace(one, default=0.1) if one.name in ('SideStep', 'ForwardStep') else one\n"
        "             for one in properties.PROPERTIES)\n"
        "coarse, properties.PROPERTIES = properties.PROPERTIES, fine"
    )
    click_top_face(window)
    press(window, "MPM_Finish")
    press_cancel(window, picture="4-progress")
    window.run("properties.PROPERTIES = coarse")
    assert window.run("result = [obj.Name for obj in doc.Objects]") == ["Block"]


def test_an_operation_without_a_path_wears_a_warning_and_recovers(window: FreeCADWindow, part: None) -> None:
    icon = "result = os.path.basename(op.ViewObject.Proxy.getIcon())"
    assert window.run(COARSE + icon) == "multi_point_finish.svg"
    assert window.run("op.SideStep = 0\ndoc.recompute()\n" + icon) == "problem.svg"
    assert set(window.run(DRAWN).values()) == {0}
    assert window.run("op.SideStep = 20\ndoc.recompute()\n" + icon) == "multi_point_finish.svg"
    assert min(window.run(DRAWN).values()) > 0


def edit_page(window: FreeCADWindow) -> None:
    window.run(
        "from freecad_mpm.gui.edit_page import EditPage\n"
        "Gui.ActiveDocument.setEdit(op)\n"
        "page = next(p for p in op.ViewObject.Proxy.panel.featurePages if isinstance(p, EditPage))"
    )


def test_a_value_typed_into_the_page_recomputes(window: FreeCADWindow, part: None) -> None:
    before = window.run(COARSE + "result = op.Report")
    edit_page(window)
    window.screenshot("5-edit")
    window.run("field = next(f for f in page._fields if f.name == 'ForwardStep')\n")
    window.type("field.widget", "0.5 in")
    press_in_panel(window, "Ok")
    assert window.run("result = op.ForwardStep.Value") == 12.7
    # Not the number of positions: with longer steps more are put in between.
    assert "forward step 8 mm" in before and "forward step 12.7 mm" in window.run("result = op.Report")


def test_cancel_in_the_page_changes_nothing(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + "doc.commitTransaction()")
    edit_page(window)
    press_in_panel(window, "Cancel")
    assert window.run("result = [doc.getObject('MultiPointFinish') is op, op.ForwardStep.Value]") == [
        True,
        8.0,
    ]


def test_only_faces_can_be_picked_while_the_page_is_open(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE)
    edit_page(window)
    pick = (
        "Gui.Selection.clearSelection()\n"
        "Gui.Selection.addSelection(doc.Name, op.Base[0][0].Name, {name!r})\n"
        "result = [n for s in Gui.Selection.getSelectionEx() for n in s.SubElementNames]"
    )
    assert window.run(pick.format(name="Face2")) == ["Face2"]
    assert window.run(pick.format(name="Edge1")) == []


def test_write_program_command_asks_for_a_file_and_writes(
    window: FreeCADWindow, part: None, tmp_path: Path
) -> None:
    target = tmp_path / "program.I"
    window.run(COARSE + answer_file_dialog(target))
    press(window, "MPM_WriteProgram")
    window.wait_for(lambda: written(target), "the program")
    assert target.read_text().startswith("%")


def written(file: Path) -> bool:
    """Whether the file is there with its last line."""
    return file.exists() and file.read_bytes().endswith(b"\n")


def answer_file_dialog(target: Path) -> str:
    """The native file dialog would block; its answer is given for it."""
    return "from freecad_mpm.gui import commands\n" f"commands._ask_file = lambda name: {str(target)!r}"


def test_freecads_post_process_command_writes_the_same(
    window: FreeCADWindow, part: None, tmp_path: Path
) -> None:
    stock, ours = tmp_path / "stock.I", tmp_path / "ours.I"
    command = window.run(
        COARSE + "from freecad_mpm.document import compat, program\n"
        f"program.write(op, {str(ours)!r})\n"
        "job = doc.getObject('Job')\n"
        f"job.PostProcessorOutputFile = {str(stock)!r}\n"
        "Gui.activateWorkbench('PathWorkbench' if compat.FLAT_MODULES else 'CAMWorkbench')\n"
        "Gui.Selection.clearSelection()\nGui.Selection.addSelection(job)\n"
        "result = 'Path_Post' if compat.FLAT_MODULES else 'CAM_Post'"
    )
    window.send(f"Gui.runCommand({command!r}, 0)")
    window.wait_for(lambda: written(stock), "FreeCAD's Post Process to write the program")
    window.run("Gui.activateWorkbench('MultiPointMachiningWorkbench')")
    assert stock.read_bytes() == ours.read_bytes()
