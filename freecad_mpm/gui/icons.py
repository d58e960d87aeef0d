"""The add-on's own icons; FreeCAD's built-in names differ between versions."""

from __future__ import annotations

from ..core.base import RESOURCES


def path(name: str) -> str:
    """Absolute path of the icon `name`."""
    return str(RESOURCES / "icons" / f"{name}.svg")
