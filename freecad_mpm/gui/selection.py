"""What is picked in the window: faces while an operation is edited, the operation that a command is for."""

from __future__ import annotations

from typing import Any

import FreeCAD
import FreeCADGui

from ..core.base import InputError
from ..document.model import FACE


class FaceGate:
    """Lets faces be picked, nothing else."""

    def allow(self, doc: Any, obj: Any, sub: str) -> bool:
        return sub.rsplit(".", 1)[-1].startswith(FACE)


def select_faces() -> None:
    """Allow only faces until CAM's panel closes, which takes every gate away."""
    FreeCADGui.Selection.addSelectionGate(FaceGate())


def operation() -> Any:
    """The selected operation, or the only one of the document. Raises InputError when it is not one alone."""
    from ..document.operation import is_operation

    chosen = [obj for obj in FreeCADGui.Selection.getSelection() if is_operation(obj)]
    found = chosen or [obj for obj in FreeCAD.ActiveDocument.Objects if is_operation(obj)]
    if len(found) != 1:
        raise InputError(f"select one Multi-Point Finish operation; there are {len(found)}")
    return found[0]
