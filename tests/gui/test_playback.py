"""Playback in a real window: the panel's buttons by mouse, the nodes in the view, frames while it plays."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from freecad_window import FreeCADWindow
from test_pick_and_finish import COARSE, dialog_text, press

PANEL = """
import gc
from freecad_mpm.gui import playback_panel
panel = next(o for o in gc.get_objects() if isinstance(o, playback_panel.PlaybackPanel) and o._watch.active)
form = panel.form
"""
WORD = "result = form._words[{!r}].text()"
# How many nodes the view holds beside each other, where objects and ours may be.
NODES = """
from pivy import coin
from freecad_mpm.gui import playback_nodes
scene = view.getSceneGraph()
objects = playback_nodes._parent(scene, op.ViewObject.RootNode)
result = scene.getNumChildren() + objects.getNumChildren()
"""
# Frames that Coin draws while it plays, and processor time of the whole program for each.
FRAMES = """
import time
from pivy import coin
drawn = []
def count(data, action):
    if action.isOfType(coin.SoGLRenderAction.getClassTypeId()):
        drawn.append(time.perf_counter())
counter = coin.SoCallback()
counter.setCallback(count, None)
def frames(seconds):
    del drawn[:]
    began = time.process_time()
    panel.play()
    settle(int(1000 * seconds))
    panel.pause()
    return [len(drawn) / seconds, (time.process_time() - began) / max(len(drawn), 1)]
"""
# A path of so many positions that nobody waits for: playback needs the stored path alone.
LONG = """
import numpy as np
import Path
from types import SimpleNamespace
from freecad_mpm.document import cl_path
count = 100_000
at = np.arange(count)
x, y = 120 * (at // 500) / 200, 80 * (at % 500) / 500
axis = np.column_stack((0.2 * np.sin(y / 10), 0.2 * np.cos(x / 9), np.ones(count)))
moves = SimpleNamespace(kind=np.where(at == 0, "rapid", "cut"), pass_index=at // 500,
                        tip=np.column_stack((x, y, 6 * np.sin(x / 22) * np.cos(y / 18))),
                        axis=axis / np.linalg.norm(axis, axis=1)[:, None])
op.Path = Path.Path(cl_path.to_commands(moves, cl_path.Feeds(20.0, 10.0)))
op.StatusNames = ["two_contacts"]
op.MoveStatus = np.where(at == 0, -1, 0).tolist()
op.PositionClearance = [0.0] * (count - 1)
op.purgeTouched()
"""


@pytest.fixture
def panel(window: FreeCADWindow, part: None) -> Iterator[None]:
    window.run(COARSE + "unfold(op)\nsettle(300)")
    press(window, "MPM_Playback")
    window.wait(lambda: window.run("result = Gui.Control.activeDialog()"))
    window.run("settle(500)\n" + PANEL)
    yield
    window.run("Gui.Control.closeDialog()\npanel.close()")


def click_on(window: FreeCADWindow, widget: str) -> None:
    window.click(window.run(f"result = middle_of(form.{widget})"))
    window.run("settle(100)")


def test_the_buttons_move_the_tool(window: FreeCADWindow, panel: None) -> None:
    where = "m = panel._nodes._matrices['tool'].matrix.getValue().getValue()\nresult = list(m[3][:3])"
    start = window.run(where)
    click_on(window, "forth")
    click_on(window, "forth")
    assert window.run(WORD.format("Position")) == f"2 of {window.run('result = op.Positions')}"
    tip = window.run(
        "from freecad_mpm.document import cl_path\n"
        "moves = cl_path.from_commands(op.Path.Commands)\n"
        "reached = [i for i, code in enumerate(op.MoveStatus) if code >= 0]\n"
        "result = moves.tip[reached[1]].tolist()"
    )
    assert window.run(where) == pytest.approx(tip, abs=1e-4) and start != tip
    click_on(window, "back")
    assert window.run(WORD.format("Position")).startswith("1 of")
    assert window.run(WORD.format("Status")) == "two contacts"
    assert window.run(WORD.format("Clearance")).endswith("µm")
    click_on(window, "last")
    assert window.run("result = panel.place == panel.played.playback.last")
    click_on(window, "first")
    assert window.run("result = panel.place") == 0


def test_play_and_pause(window: FreeCADWindow, panel: None) -> None:
    window.run("form.speed.setCurrentIndex(playback_panel.SPEEDS.index(5))\nview.fitAll()\nsettle(300)")
    click_on(window, "run")
    window.run("settle(1500)")
    click_on(window, "run")
    reached = window.run("settle(100)\nresult = panel.place")
    assert 0 < reached < window.run("result = panel.played.playback.last")
    assert window.run("settle(300)\nresult = panel.place") == reached
    window.screenshot("6-playback")


def test_the_slider_and_the_number_go_to_a_position(window: FreeCADWindow, panel: None) -> None:
    window.run("form.slider.setValue(20)")
    assert window.run(WORD.format("Position")).startswith("21 of")
    click_on(window, "number")
    window.run("form.number.selectAll()")
    window.type("8")
    assert window.run("settle(200)\n" + WORD.format("Position")).startswith("8 of")
    assert window.run("result = form.slider.value()") == 7


def test_in_the_machines_view_the_part_turns_with_the_table(window: FreeCADWindow, panel: None) -> None:
    place = "panel.go_to_position(40)\nsettle(300)\n"
    turned = (
        "m = panel._nodes.part.matrix.getValue()\nresult = bool(m.equals(coin.SbMatrix.identity(), 1e-6))"
    )
    window.run("from pivy import coin")
    assert window.run(place + turned) is True
    window.run("form.view.setCurrentIndex(1)\nview.fitAll()\nsettle(500)")
    window.screenshot("7-playback-machine")
    assert window.run(turned) is False


def test_closing_leaves_the_view_as_it_was(window: FreeCADWindow, part: None) -> None:
    count = NODES
    before = window.run(COARSE + "settle(300)\n" + count)
    window.run(
        "from freecad_mpm.gui import playback_panel\npanel = playback_panel.open_panel(op)\nsettle(300)"
    )
    assert window.run(count) > before
    window.click(window.run("result = panel_button(QtGui.QDialogButtonBox.Close)"))
    window.wait(lambda: not window.run("result = Gui.Control.activeDialog()"))
    assert window.run(count) == before


def test_the_operation_computed_anew_is_what_plays(window: FreeCADWindow, panel: None) -> None:
    before = window.run("result = form.slider.maximum()")
    window.run("op.ForwardStep = 16\ndoc.recompute()\nsettle(300)")
    after = window.run("result = [form.slider.maximum() + 1, op.Positions]")
    assert after[0] == after[1] and after[0] != before + 1


def test_closing_the_document_ends_it(window: FreeCADWindow, panel: None) -> None:
    window.run("panel.play()\nsettle(200)\nFreeCAD.closeDocument(doc.Name)\nsettle(500)")
    assert window.run("result = [panel._timer.isActive(), Gui.Control.activeDialog()]") == [False, False]


def test_without_a_path_the_user_is_told(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + "op.SideStep = 0\ndoc.recompute()\nunfold(op)")
    press(window, "MPM_Playback")
    assert "there is no up-to-date path" in dialog_text(window)


def test_a_hundred_thousand_positions_play_as_quickly_as_a_few(window: FreeCADWindow, part: None) -> None:
    start = (
        "from freecad_mpm.gui import playback_panel\n"
        "panel = playback_panel.open_panel(op)\n"
        "panel.form.speed.setCurrentIndex(playback_panel.SPEEDS.index(1))\n"
        "panel._nodes.root.addChild(counter)\nview.fitAll()\nsettle(500)\n"
        "result = [frames(1) for _ in range(3)]"
    )
    few = window.run(COARSE + FRAMES + start)
    window.run("panel.reject()\nsettle(200)\n" + LONG)
    many = window.run(start)
    shown = "result = op.ViewObject.SwitchNode.whichChild.getValue()"
    hidden = window.run(shown)
    assert window.run("panel.reject()\n" + shown) != hidden == -1
    rates = [f"{rate:.0f}/s {1000 * seconds:.0f} ms" for rate, seconds in few + many]
    print("frames a second, processor time a frame: few", *rates[:3], "many", *rates[3:])
    # Frames a second depend on what else the computer does; processor time for each hardly, when it is let work.
    assert min(seconds for _, seconds in many) < 2 * min(seconds for _, seconds in few)
