"""Picking in the 3D view while an operation is edited."""

from __future__ import annotations

from typing import Any

import FreeCADGui

from ..document.model import FACE


class FaceGate:
    """Lets faces be picked, nothing else."""

    def allow(self, doc: Any, obj: Any, sub: str) -> bool:
        return sub.rsplit(".", 1)[-1].startswith(FACE)


def select_faces() -> None:
    """Allow only faces until CAM's panel closes, which takes every gate away."""
    FreeCADGui.Selection.addSelectionGate(FaceGate())
