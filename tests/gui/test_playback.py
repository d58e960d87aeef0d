"""Playback in a real window: the panel's buttons by mouse, the nodes in the view, frames while it plays."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from freecad_window import FreeCADWindow
from window_words import COARSE, NODES, dialog_text, press, press_in_panel

WORD = "result = form._words[{!r}].text()"
# What the whole program's processor time is whenever Coin has drawn a frame.
FRAMES = """
import time
from pivy import coin
drawn = []
def count(data, action):
    if action.isOfType(coin.SoGLRenderAction.getClassTypeId()):
        drawn.append(time.process_time())
counter = coin.SoCallback()
counter.setCallback(count, None)
"""
FRAMES_COUNTED = 20
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
    window.run(COARSE + "unfold(op)")
    press(window, "MPM_Playback")
    window.wait_for("panel is not None", "the playback panel")
    window.run("form = panel.form")
    yield
    window.run("Gui.Control.closeDialog()\npanel.close()")


def click_on(window: FreeCADWindow, widget: str) -> None:
    window.click(f"middle_of(form.{widget})")


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
    # So slowly that it does not come to the end before the second click, however late that is.
    slow = "form.speed.setCurrentIndex(playback_panel.SPEEDS.index(0.1))\n"
    start = window.run(slow + "view.fitAll()\npanel.go_to_position(20)\nresult = panel.place")
    click_on(window, "run")
    window.wait_for(f"panel.place > {start}", "the tool to move on")
    click_on(window, "run")
    reached = window.run("result = panel.place")
    assert start < reached < window.run("result = panel.played.playback.last")
    assert window.run("idle()\nresult = [panel._timer.isActive(), panel.place]") == [False, reached]
    window.screenshot("6-playback")


def test_the_slider_and_the_number_go_to_a_position(window: FreeCADWindow, panel: None) -> None:
    window.run("form.slider.setValue(20)")
    assert window.run(WORD.format("Position")).startswith("21 of")
    window.type("form.number", "8")
    assert window.run(WORD.format("Position")).startswith("8 of")
    assert window.run("result = form.slider.value()") == 7


def test_in_the_machines_view_the_part_turns_with_the_table(window: FreeCADWindow, panel: None) -> None:
    place = "panel.go_to_position(40)\n"
    turned = (
        "m = panel._nodes.part.matrix.getValue()\nresult = bool(m.equals(coin.SbMatrix.identity(), 1e-6))"
    )
    window.run("from pivy import coin")
    assert window.run(place + turned) is True
    window.run("form.view.setCurrentIndex(1)\nview.fitAll()")
    window.screenshot("7-playback-machine")
    assert window.run(turned) is False


def test_closing_leaves_the_view_as_it_was(window: FreeCADWindow, part: None) -> None:
    count = NODES
    before = window.run(COARSE + "idle()\n" + count)
    window.run("playback_panel.open_panel(op)")
    assert window.run(count) > before
    press_in_panel(window, "Close")
    assert window.run(count) == before


def test_the_operation_computed_anew_is_what_plays(window: FreeCADWindow, panel: None) -> None:
    before = window.run("result = form.slider.maximum()")
    window.run("op.ForwardStep = 16\ndoc.recompute()")
    after = window.run("result = [form.slider.maximum() + 1, op.Positions]")
    assert after[0] == after[1] and after[0] != before + 1


def test_closing_the_document_ends_it(window: FreeCADWindow, panel: None) -> None:
    window.run("panel.play()\nidle()\nFreeCAD.closeDocument(doc.Name)")
    window.wait_for("not panel._timer.isActive() and not Gui.Control.activeDialog()", "playback to end")


def test_without_a_path_the_user_is_told(window: FreeCADWindow, part: None) -> None:
    window.run(COARSE + "op.SideStep = 0\ndoc.recompute()\nunfold(op)")
    press(window, "MPM_Playback")
    assert "there is no up-to-date path" in dialog_text(window)


def test_a_hundred_thousand_positions_play_as_quickly_as_a_few(window: FreeCADWindow, part: None) -> None:
    few = processor_time_of_a_frame(window, COARSE + FRAMES)
    window.run("panel.reject()\n" + LONG)
    many = processor_time_of_a_frame(window)
    shown = "result = op.ViewObject.SwitchNode.whichChild.getValue()"
    hidden = window.run(shown)
    assert window.run("panel.reject()\n" + shown) != hidden == -1
    print("ms of processor time a frame: few", *(f"{1000 * seconds:.1f}" for seconds in few))
    print("many", *(f"{1000 * seconds:.1f}" for seconds in many))
    # How many frames a second there are depends on what else the computer does.
    assert min(many) < 2 * min(few)


def processor_time_of_a_frame(window: FreeCADWindow, before: str = "") -> list[float]:
    """Seconds while it plays so slowly that it does not end; three times."""
    window.run(
        before + "panel = playback_panel.open_panel(op)\n"
        "panel.form.speed.setCurrentIndex(playback_panel.SPEEDS.index(0.1))\n"
        "panel._nodes.root.addChild(counter)\nview.fitAll()\nidle()\npanel.play()"
    )
    found = []
    for _ in range(3):
        window.run("del drawn[:]")
        window.wait_for(f"len(drawn) > {FRAMES_COUNTED}", f"{FRAMES_COUNTED} frames")
        found.append(window.run("result = (drawn[-1] - drawn[0]) / (len(drawn) - 1)"))
    return found
