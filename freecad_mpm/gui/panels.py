"""What the task panels share."""

from __future__ import annotations

import FreeCADGui
from PySide import QtGui

from ..core.errors import InputError


def only_close() -> int:
    """The standard buttons of a panel that only shows something."""
    close = QtGui.QDialogButtonBox.Close
    return int(getattr(close, "value", close))  # a number in PySide2, an enumeration in PySide6


def check_none_is_open() -> None:
    """Raise InputError when FreeCAD shows another task panel: there is room for one."""
    if FreeCADGui.Control.activeDialog():
        raise InputError("another task panel is open: close it first")
