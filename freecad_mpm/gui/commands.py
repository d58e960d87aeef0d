"""The workbench's commands: one row each."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..core.base import Cancelled, InputError
from . import icons
from .messages import TITLE, report
from .selection import operation


@dataclass(frozen=True)
class Command:
    """As FreeCAD wants it. Can be used while a document is open; tells an InputError in a dialog."""

    name: str
    icon: str  # of resources/icons
    text: str  # in the menu
    tip: str
    act: Callable[[], None]

    def GetResources(self) -> dict[str, str]:
        return {"Pixmap": icons.path(self.icon), "MenuText": self.text, "ToolTip": self.tip}

    def IsActive(self) -> bool:
        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
        try:
            self.act()
        except InputError as error:
            report(error)


def register() -> list[str]:
    """Make the commands known to FreeCAD; returns their names in the order of the toolbar."""
    for command in COMMANDS:
        FreeCADGui.addCommand(command.name, command)
    return [command.name for command in COMMANDS]


def _finish() -> None:
    """Picked faces -> an operation in the Job, as one step to undo; whatever fails undoes it."""
    from ..document.creation import create

    doc = FreeCAD.ActiveDocument
    faces = FreeCADGui.Selection.getSelectionEx()
    doc.openTransaction("Multi-Point Finish")
    try:
        create(doc, faces)
    except Exception as error:
        doc.abortTransaction()
        if not isinstance(error, Cancelled):
            report(error)
        return
    doc.commitTransaction()
    FreeCADGui.Selection.clearSelection()  # the faces' highlight would hide the passes on them


def _play_back() -> None:
    from .playback_panel import open_panel

    open_panel(operation())


def _verify() -> None:
    from .verification_panel import run_and_show

    run_and_show(operation())


def _write_program() -> None:
    from ..document import program

    op = operation()
    path = _ask_file(program.default_name(op))
    if path:
        program.write(op, path)
        FreeCAD.Console.PrintMessage(f"{op.Label}: program written to {path}\n")


def _ask_file(name: str) -> str:
    return QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), TITLE, name)[0]


COMMANDS = (
    Command(
        "MPM_Finish",
        "multi_point_finish",
        "Multi-Point Finish",
        "Finish the picked faces with a toroidal cutter that touches them at several points at once",
        _finish,
    ),
    Command(
        "MPM_Playback",
        "playback",
        "Playback",
        "Move the tool and the machine along the path of the selected Multi-Point Finish operation",
        _play_back,
    ),
    Command(
        "MPM_Verify",
        "verify",
        "Verify",
        "Cut the selected Multi-Point Finish operation into stock and colour how far the part is met",
        _verify,
    ),
    Command(
        "MPM_WriteProgram",
        "write_program",
        "Write Program",
        "Write the program of the selected Multi-Point Finish operation to a file",
        _write_program,
    ),
)
