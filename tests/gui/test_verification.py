"""Verify in a real window: the command by mouse, colours and legend, a click on a spot, from there to playback."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from freecad_window import FreeCADWindow
from window_words import COARSE, NODES, ROUGH, TOP_MIDDLE, dialog_text, press, press_cancel, press_in_panel

# Once `panel` is the wanted one.
PANEL = "form, result_object = panel.form, panel.result"
# Pixels of the view in the hue of a band's colour, whatever the light does to its brightness.
HUES = """
import colorsys
def share_of_hue(color):
    file = os.path.join(FreeCAD.getTempPath(), "view.png")
    view.saveImage(file, 400, 300, "White")
    image = QtGui.QImage(file)
    hue, saturation, _ = colorsys.rgb_to_hsv(*color)
    def same(pixel):
        h, s, v = colorsys.rgb_to_hsv(pixel.redF(), pixel.greenF(), pixel.blueF())
        return v > 0.1 and abs((h - hue + 0.5) % 1 - 0.5) < 0.02 and abs(s - saturation) < 0.1
    points = [QtGui.QColor(image.pixel(x, y)) for x in range(400) for y in range(300)]
    return sum(map(same, points)) / len(points)
"""


@pytest.fixture
def panel(window: FreeCADWindow, part: None) -> Iterator[None]:
    window.run(COARSE + ROUGH + "unfold(op)")
    press(window, "MPM_Verify")
    window.wait_for("panel is not None", "the panel of the verification")
    window.run(PANEL)
    yield
    window.run("Gui.Control.closeDialog()\npanel.close()")


def test_the_result_comes_and_goes_in_one_step_and_the_view_with_it(
    window: FreeCADWindow, panel: None
) -> None:
    names = "result = [obj.Name for obj in doc.Objects if obj.Name in ('Verification', 'MachinedStock')]"
    nodes = NODES
    assert sorted(window.run(names)) == ["MachinedStock", "Verification"]
    assert window.run("result = [result_object.Good, result_object.Stock.ViewObject.Visibility]") == [
        True,
        False,
    ]
    before = window.run(nodes)
    window.click("middle_of(form.remainder)")
    assert window.run(nodes) > before
    press_in_panel(window, "Close")
    assert window.run(nodes) == before
    assert window.run("doc.undo()\n" + names) == []
    assert sorted(window.run("doc.redo()\n" + names)) == ["MachinedStock", "Verification"]


def test_colours_and_legend_are_seen_and_hidden(window: FreeCADWindow, panel: None) -> None:
    window.run(HUES + "op.ViewObject.Visibility = False\nview.viewTop()\nview.fitAll()")
    window.screenshot("8-verification")
    share = (
        "from freecad_mpm.core.removal import bands as deviation_bands\n"
        "bands = deviation_bands.bands(result_object.Tolerance.Value)\n"
        "result = [share_of_hue(deviation_bands.COLOURS[band]) for band in (1, 2, 4, 5)]"
    )
    shown = window.run(share)
    assert min(shown) > 0.0002  # the legend has each of them
    assert sum(shown) > 0.15  # and the face most
    assert max(window.run("result_object.ViewObject.Visibility = False\n" + share)) < 0.0002


def test_a_click_on_a_spot_tells_the_position_that_cut_it(window: FreeCADWindow, panel: None) -> None:
    window.run("op.ViewObject.Visibility = False\nview.fitAll()")
    window.run("from freecad_mpm.document import verification")
    window.click(TOP_MIDDLE)
    words = window.run("result = form.spot_words()")
    position = window.run("result = verification.position_at(op, panel.move)")
    assert position >= 0 and words["Cut last by"].endswith(
        f"position {position + 1} of {window.run('result = op.Positions')}"
    )
    window.screenshot("9-verification-spot")
    # The tool that cut the spot stands within its radius of it.
    distance = window.run(
        "m = panel._nodes._matrices['tool'].matrix.getValue().getValue()\n"
        "import numpy as np\n"
        "spot = np.array([float(x) for x in form.spot_words()['Point'].split(', ')])\n"
        "result = float(np.linalg.norm(np.array(m[3][:3]) - spot))"
    )
    assert distance < 2 * 12.7
    window.click("middle_of(form.play)")
    window.wait_for(
        "isinstance(panel, playback_panel.PlaybackPanel) and panel.place > 0", "playback from there"
    )
    shown = window.run("result = panel.played.playback.position_before(panel.place)\npanel.reject()")
    assert shown == position


def test_the_worst_places_are_shown(window: FreeCADWindow, panel: None) -> None:
    for button, name in (("gouge", "WorstGouge"), ("remainder", "WorstRemainder")):
        window.click(f"middle_of(form.{button})")
        words = window.run("result = form.spot_words()")
        assert words["Deviation"] == window.run(f"result = form.{button}.text()")
        point = [float(value) for value in words["Point"].split(", ")]
        assert point == pytest.approx(window.run(f"result = list(result_object.{name}Point)"), abs=2e-3)


def test_a_double_click_opens_the_panel_again_and_says_when_the_path_is_another(
    window: FreeCADWindow, panel: None
) -> None:
    assert window.run("result = form._history.isVisible()") is False
    window.run("op.ForwardStep = 16\ndoc.recompute()")
    assert window.run("result = form._history.isVisible()") is True
    window.run("panel.reject()")
    icon = "result = os.path.basename(result_object.ViewObject.Proxy.getIcon())"
    assert window.run(icon) == "problem.svg"
    window.run("result_object.ViewObject.Proxy.doubleClicked(result_object.ViewObject)\n" + PANEL)
    told = "result = form._history.isVisible()"
    assert window.run(told) is True
    window.click("middle_of(form.remainder)")
    assert window.run("result = form.spot_words()['Cut last by']").endswith("as it was")


def test_without_a_path_the_user_is_told(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + "op.SideStep = 0\ndoc.recompute()\nunfold(op)")
    press(window, "MPM_Verify")
    assert "there is no up-to-date path" in dialog_text(window)
    assert window.run("result = doc.getObject('Verification') is None")


def test_verify_again_with_another_resolution(window: FreeCADWindow, panel: None) -> None:
    before = window.run("first = panel\nresult = len(panel._found.points)")
    window.type("form.resolution", "3 mm")
    window.click("middle_of(form.again)")
    window.wait_for("panel is not first", "the panel of the new result")
    assert window.run(PANEL + "\nresult = result_object.Resolution.Value") == 3
    assert window.run("result = len(panel._found.points)") == pytest.approx(before / 4, rel=0.2)


def test_cancel_in_the_progress_dialog_leaves_nothing(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + ROUGH + "cutting.DEXELS_ALONG = 1500\nunfold(op)")
    press(window, "MPM_Verify")
    press_cancel(window)
    assert window.run("result = [doc.getObject('Verification'), doc.getObject('MachinedStock')]") == [
        None,
        None,
    ]


def test_a_reopened_document_shows_the_colours(window: FreeCADWindow, panel: None, tmp_path) -> None:
    before = window.run("result = result_object.ViewObject.Proxy.nodes.count")
    file = str(tmp_path / "part.FCStd")
    window.run(f"panel.reject()\ndoc.saveAs({file!r})\nFreeCAD.closeDocument(doc.Name)")
    window.run(f"doc = FreeCAD.openDocument({file!r})\nview = Gui.ActiveDocument.ActiveView")
    after = window.run("result = doc.getObject('Verification').ViewObject.Proxy.nodes.count")
    assert after == before > 1000


def test_closing_the_document_ends_it(window: FreeCADWindow, panel: None) -> None:
    window.run("FreeCAD.closeDocument(doc.Name)")
    window.wait_for("not panel._watch.active and not Gui.Control.activeDialog()", "the panel to close")
