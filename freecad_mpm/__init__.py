"""Multi-point five-axis machining with toroidal cutters: `plan` (without FreeCAD) and `create` (in FreeCAD)."""

from __future__ import annotations

from .core.version import __version__

__all__ = ["__version__", "create", "plan"]


def __getattr__(name: str) -> object:
    """Import the two entry points on first use: FreeCAD imports this package at start, which must stay quick."""
    if name == "plan":
        from .core.planning import plan

        return plan
    if name == "create":
        from .document import create

        return create
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
