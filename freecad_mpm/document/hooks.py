"""What the GUI adds to the document layer, which runs without it. Imports nothing: FreeCAD's start needs this early."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def run_here(call: Callable[..., Any]) -> Any:
    """Run `call(on_progress=..., cancel=...)` without showing anything, as FreeCADCmd and scripts do."""
    return call(on_progress=None, cancel=None)


def show_nothing(obj: Any) -> None:
    """What becomes of a new object's view where there is none."""


# How a computation runs; the GUI's shows progress and can be cancelled.
run: Callable[[Callable[..., Any]], Any] = run_here
# Called with every new operation; the GUI's gives it a view provider.
present: Callable[[Any], None] = show_nothing
# Called with every new result of a verification.
present_result: Callable[[Any], None] = show_nothing
