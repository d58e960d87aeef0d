"""The whole way in a real window: click a face, click the command, look at the path."""

from __future__ import annotations

from freecad_window import FreeCADWindow


FINISHED = "op = doc.getObject('MultiPointFinish')\nresult = op is not None and not doc.HasPendingTransaction"


def click_top_face(window: FreeCADWindow) -> None:
    window.click(window.run("result = on_screen(middle_of_face(block, top))"))


def test_click_on_a_face_and_the_command_make_an_operation(window: FreeCADWindow, part: None) -> None:
    click_top_face(window)
    picked = window.run("result = [[s.ObjectName, *s.SubElementNames] for s in Gui.Selection.getSelectionEx()]")
    assert picked == [["Block", window.run("result = top")]]
    window.screenshot("1-face-picked")

    window.click(window.run("result = button_of('MPM_Finish')"))
    window.wait(lambda: window.run(FINISHED))
    facts = window.run(
        "op = doc.MultiPointFinish\n"
        "result = dict(problem=op.Problem, moves=len(op.Path.Commands), positions=op.Positions,\n"
        "              cuts=op.ViewObject.Proxy.nodes.cuts.count)"
    )
    window.run("settle(500)")
    window.screenshot("2-operation")
    assert facts["problem"] == ""
    assert facts["positions"] > 100
    assert facts["cuts"] > 100
