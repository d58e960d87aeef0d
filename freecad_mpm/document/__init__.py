"""The operation in FreeCAD's App: properties, faces as arrays, posts. Runs in FreeCADCmd; never imports the GUI."""

from __future__ import annotations


def __getattr__(name: str) -> object:
    """`create`, imported on first use: CAM must not be loaded while FreeCAD is still starting."""
    if name == "create":
        from .creation import create

        return create
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
