"""Commands, task panel and 3D view: FreeCADGui, Qt and Coin."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from ..document import hooks


def install() -> None:
    """Make operations show themselves and their progress, also those that a script or macro makes."""
    hooks.run = _run
    hooks.present = _present
    hooks.present_result = _present_result


def _run(call: Callable[..., Any]) -> Any:
    from .progress import run_with_dialog

    return run_with_dialog(call)


def _present(op: Any) -> None:
    from .view_provider import show

    show(op)


def _present_result(result: Any) -> None:
    from .verification_view import show

    show(result)
