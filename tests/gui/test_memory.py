"""A field that loses the focus to the 3D view, then another panel: what FreeCAD 1.1 did not survive."""

from __future__ import annotations

import pytest
from freecad_window import FreeCADWindow
from test_pick_and_finish import COARSE, click_top_face
from test_verification import ROUGH

EDIT = "Gui.ActiveDocument.setEdit(op.Name, 0)"
VERIFY = (
    "from freecad_mpm.document import verification\nfrom freecad_mpm.gui import verification_panel\n"
    "Gui.Control.showDialog(verification_panel.VerificationPanel(verification.verify(op)))"
)
FOCUS = (
    "box = [w for w in window.findChildren(QtGui.QAbstractSpinBox) if w.isVisible()][-1]\nbox.setFocus()\n"
    "op.ViewObject.Visibility = False\nview.fitAll()\nsettle(500)\nresult = box.hasFocus()\ndel box"
)
PLAYBACK = "from freecad_mpm.gui import playback_panel\nplayback_panel.open_panel(op)\nsettle(300)"
CLOSE = "Gui.ActiveDocument.resetEdit()\nGui.Control.closeDialog()\nsettle(300)"


@pytest.mark.parametrize("shown", [EDIT, VERIFY], ids=["edit", "verify"])
def test_a_panel_left_by_a_click_into_the_view_leaves_the_memory_whole(
    window: FreeCADWindow, part: None, shown: str
) -> None:
    window.run(COARSE + ROUGH + "unfold(op)\nsettle(300)\n" + shown + "\nsettle(500)")
    assert window.run(FOCUS)
    click_top_face(window)
    window.run(CLOSE)
    for _ in range(2):
        window.run(PLAYBACK)
        window.run(CLOSE)
    assert window.run("result = Gui.Control.activeDialog()") is False
