"""Multi-point five-axis machining with toroidal cutters: `plan` (without FreeCAD) and `create` (in FreeCAD)."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from .version import __version__

__all__ = ["__version__", "create", "plan"]

# Entry point -> its module, imported on first use: FreeCAD imports this package at start, which must stay quick.
_MODULES = {"plan": "core.planning", "create": "document"}


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
