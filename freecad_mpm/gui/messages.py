"""What the window says of an error, under the add-on's name."""

from __future__ import annotations

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..core.base import InputError, one_line

TITLE = "Multi-Point Machining"


def report(error: Exception) -> None:
    """Tell the user in a dialog; the report view keeps the line."""
    text = one_line(error) if isinstance(error, InputError) else f"{type(error).__name__}: {one_line(error)}"
    FreeCAD.Console.PrintError(f"{TITLE}: {text}\n")
    QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), TITLE, text)
