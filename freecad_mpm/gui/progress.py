"""A progress dialog around a computation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCADGui
from PySide import QtCore, QtGui

STEPS = 1000
SHOWN_AFTER_MS = 400
WIDTH_PX = 380


def run_with_dialog(call: Callable[..., Any]) -> Any:
    """Run `call(on_progress=..., cancel=...)`; its progress is shown, and Cancel or Esc stops it.

    The call works in its own threads and reports from this one, which keeps the window alive."""
    dialog = QtGui.QProgressDialog("Computing", "Cancel", 0, STEPS, FreeCADGui.getMainWindow())
    dialog.setWindowTitle("Multi-Point Finish")
    dialog.setWindowModality(QtCore.Qt.ApplicationModal)
    dialog.setMinimumDuration(SHOWN_AFTER_MS)
    dialog.setMinimumWidth(WIDTH_PX)
    dialog.setAutoReset(False)

    def on_progress(stage: str, fraction: float) -> None:
        dialog.setLabelText(f"Computing: {stage}")
        dialog.setValue(int(STEPS * fraction))  # handles events too, as the dialog is modal
        QtGui.QApplication.processEvents()

    try:
        return call(on_progress=on_progress, cancel=dialog.wasCanceled)
    finally:
        dialog.close()
        dialog.deleteLater()
