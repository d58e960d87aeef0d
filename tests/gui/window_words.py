"""What the window tests say and do alike: scripts that run inside FreeCAD, and buttons pressed with the mouse."""

from __future__ import annotations

from freecad_window import FreeCADWindow

TOP_MIDDLE = "on_screen(middle_of_face(block, top))"
PROGRESS = """
box = window.findChild(QtGui.QProgressDialog)
result = box is not None and box.isVisible() and box.windowHandle().isExposed()
"""
# Few positions, so that a test takes seconds; pictures are made with finer steps.
COARSE = "import freecad_mpm\nop = freecad_mpm.create(doc, [(block, top)], SideStep=20, ForwardStep=8)\n"
# Few points, so that a test takes seconds.
ROUGH = "from freecad_mpm.core.removal import cutting\ncutting.DEXELS_ALONG = 80\n"
# How many nodes the view holds beside each other, where objects and ours may be.
NODES = """
from pivy import coin
from freecad_mpm.gui import playback_nodes
scene = view.getSceneGraph()
objects = playback_nodes._parent(scene, op.ViewObject.RootNode)
result = scene.getNumChildren() + objects.getNumChildren()
"""


def press(window: FreeCADWindow, command: str) -> None:
    window.click(f"button_of({command!r})")


def press_in_panel(window: FreeCADWindow, button: str) -> None:
    """A button of the task panel that ends it."""
    window.click(f"panel_button(QtGui.QDialogButtonBox.{button})")
    window.wait_for("not Gui.Control.activeDialog()", "the task panel to close")


def press_cancel(window: FreeCADWindow, picture: str = "") -> None:
    """Cancel in the progress dialog, as soon as it stands on the screen; all is over then."""
    window.wait_for(lambda: window.run(PROGRESS), "the progress dialog")
    if picture:
        window.screenshot(picture)
    window.click("middle_of(box.findChild(QtGui.QPushButton))")
    window.wait_for("not doc.HasPendingTransaction", "the cancelled command to end")


def dialog_text(window: FreeCADWindow) -> str:
    """The text of the message box that is open; it is closed."""
    window.wait_for("message_box() is not None", "a message box")
    return str(window.run("box = message_box()\nresult = box.text()\nbox.accept()"))
