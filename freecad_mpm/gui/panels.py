"""What the task panels share."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import FreeCADGui
from PySide import QtCore, QtGui

from ..core.errors import InputError


def only_close() -> int:
    """The standard buttons of a panel that only shows something."""
    close = QtGui.QDialogButtonBox.Close
    return int(getattr(close, "value", close))  # a number in PySide2, an enumeration in PySide6


def check_none_is_open() -> None:
    """Raise InputError when FreeCAD shows another task panel: there is room for one."""
    if FreeCADGui.Control.activeDialog():
        raise InputError("another task panel is open: close it first")


def view_of(document: Any) -> Any:
    """The document's active 3D view. Raises InputError when a sheet or drawing is active instead."""
    view = FreeCADGui.getDocument(document.Name).ActiveView
    if not hasattr(view, "getSceneGraph"):
        raise InputError(f"{document.Label}: its 3D view must be the active one")
    return view


@contextmanager
def busy() -> Iterator[None]:
    """The pointer says so while something takes a second or two."""
    QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
    try:
        yield
    finally:
        QtGui.QApplication.restoreOverrideCursor()
