"""The workbench's commands."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..core.base import Cancelled, InputError
from . import icons
from .messages import TITLE, report
from .selection import operation


class FinishCommand:
    """Pick faces -> an operation in the Job."""

    name = "MPM_Finish"

    def GetResources(self) -> dict[str, str]:
        return {
            "Pixmap": icons.path("multi_point_finish"),
            "MenuText": "Multi-Point Finish",
            "ToolTip": "Finish the picked faces with a toroidal cutter that touches them at several points at once",
        }

    def IsActive(self) -> bool:
        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
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


class WriteProgramCommand:
    """The operation's program -> a file."""

    name = "MPM_WriteProgram"

    def GetResources(self) -> dict[str, str]:
        return {
            "Pixmap": icons.path("write_program"),
            "MenuText": "Write Program",
            "ToolTip": "Write the program of the selected Multi-Point Finish operation to a file",
        }

    def IsActive(self) -> bool:
        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
        from ..document import program

        try:
            op = operation()
            path = _ask_file(program.default_name(op))
            if path:
                program.write(op, path)
                FreeCAD.Console.PrintMessage(f"{op.Label}: program written to {path}\n")
        except InputError as error:
            report(error)


class PlaybackCommand:
    """The tool and the machine along the operation's path."""

    name = "MPM_Playback"

    def GetResources(self) -> dict[str, str]:
        return {
            "Pixmap": icons.path("playback"),
            "MenuText": "Playback",
            "ToolTip": "Move the tool and the machine along the path of the selected Multi-Point Finish operation",
        }

    def IsActive(self) -> bool:
        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
        from .playback_panel import open_panel

        try:
            open_panel(operation())
        except InputError as error:
            report(error)


class VerifyCommand:
    """What the operation's path leaves of the stock, against the part."""

    name = "MPM_Verify"

    def GetResources(self) -> dict[str, str]:
        return {
            "Pixmap": icons.path("verify"),
            "MenuText": "Verify",
            "ToolTip": "Cut the selected Multi-Point Finish operation into stock and colour how far the part is met",
        }

    def IsActive(self) -> bool:
        return FreeCAD.ActiveDocument is not None

    def Activated(self) -> None:
        from .verification_panel import run_and_show

        try:
            run_and_show(operation())
        except InputError as error:
            report(error)


COMMANDS: tuple[Any, ...] = (FinishCommand, PlaybackCommand, VerifyCommand, WriteProgramCommand)


def register() -> list[str]:
    """Make the commands known to FreeCAD; returns their names in the order of the toolbar."""
    for command in COMMANDS:
        FreeCADGui.addCommand(command.name, command())
    return [command.name for command in COMMANDS]


def _ask_file(name: str) -> str:
    return QtGui.QFileDialog.getSaveFileName(FreeCADGui.getMainWindow(), TITLE, name)[0]
