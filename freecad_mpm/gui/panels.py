"""What the task panels share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..core.base import FORMS, InputError


class ClosingPanel:
    """What FreeCAD asks of a task panel that only shows something: one button, and what it does. Names are FreeCAD's."""

    def close(self) -> None:
        """Take back all that the panel has put into the view and the document."""
        raise NotImplementedError

    def getStandardButtons(self) -> int:
        close = QtGui.QDialogButtonBox.Close
        return int(getattr(close, "value", close))  # a number or an enumeration, by the Qt binding

    def reject(self) -> bool:
        self.close()
        FreeCADGui.Control.closeDialog()
        return True


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


def quantity_field(unit: str) -> tuple[Any, Any]:
    """A widget to put into a form, and the Gui::QuantitySpinBox in it.

    As FreeCAD's own panels have it, from a form: one that Gui.UiLoader made damages 1.1's memory once it loses the focus
    to the 3D view."""
    field = FreeCADGui.PySideUic.loadUi(str(FORMS / "quantity.ui"))
    field.box.setProperty("unit", unit)
    return field, field.box


@contextmanager
def busy() -> Iterator[None]:
    """The pointer says so while something takes a second or two."""
    QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
    try:
        yield
    finally:
        QtGui.QApplication.restoreOverrideCursor()


class Watch:
    """Calls `recomputed` when the object `obj` is computed anew, and `gone` when it or its document goes away, until
    `end`. The names of the slots are FreeCAD's."""

    def __init__(self, obj: Any, recomputed: Callable[[], None], gone: Callable[[], object]) -> None:
        self._obj, self._document = obj, obj.Document
        self._recomputed, self._gone = recomputed, gone
        self.active = True
        FreeCAD.addDocumentObserver(self)

    def end(self) -> None:
        """Calling it again changes nothing."""
        if self.active:
            FreeCAD.removeDocumentObserver(self)
            self.active = False

    def slotRecomputedObject(self, obj: Any) -> None:
        if obj == self._obj:
            self._recomputed()

    def slotDeletedObject(self, obj: Any) -> None:
        if obj == self._obj:
            self._gone()

    def slotDeletedDocument(self, document: Any) -> None:
        if document == self._document:
            self._gone()
