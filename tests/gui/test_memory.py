"""A field that loses the focus to the 3D view, then another panel: what FreeCAD 1.1 did not survive."""

from __future__ import annotations

import pytest
from freecad_window import FreeCADWindow
from window_words import COARSE, ROUGH, TOP_MIDDLE

EDIT = "Gui.ActiveDocument.setEdit(op.Name, 0)"
VERIFY = (
    "from freecad_mpm.document import verification\nverification_panel.open_panel(verification.verify(op))"
)
FIELD = "[w for w in window.findChildren(QtGui.QAbstractSpinBox) if w.isVisible()][-1]"
SHOW_FACE = "op.ViewObject.Visibility = False\nview.fitAll()"
PLAYBACK = "playback_panel.open_panel(op)\nidle()"
CLOSE = "Gui.ActiveDocument.resetEdit()\nGui.Control.closeDialog()\nidle()"


@pytest.mark.parametrize("shown", [EDIT, VERIFY], ids=["edit", "verify"])
def test_a_panel_left_by_a_click_into_the_view_leaves_the_memory_whole(
    window: FreeCADWindow, part: None, shown: str
) -> None:
    window.run(COARSE + ROUGH + "unfold(op)\n" + shown)
    window.run(f"window.activateWindow()\n{FIELD}.setFocus()\n" + SHOW_FACE)
    window.wait_for(f"{FIELD}.hasFocus()", "the focus on the last field")
    window.click(TOP_MIDDLE)
    assert (
        window.run("result = isinstance(QtGui.QApplication.focusWidget(), QtGui.QAbstractSpinBox)") is False
    )
    window.run(CLOSE)
    for _ in range(2):
        window.run(PLAYBACK)
        window.run(CLOSE)
    assert window.run("result = Gui.Control.activeDialog()") is False
