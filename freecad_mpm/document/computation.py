"""Computing an operation: from its faces, tool and properties to a core `Plan`."""

from __future__ import annotations

from typing import Any

from ..core.base import InputError
from . import hooks


class NativeModuleMissing(InputError):
    """The add-on was copied but not built."""


def compute(op: Any, job: Any) -> tuple[Any, str]:
    """The plan of operation `op` in CAM job `job`, and its report text.

    Raises InputError (what is wrong with which property), core.base.Cancelled, NativeModuleMissing."""
    require_native()
    from ..core import planning
    from ..core.report import text
    from .job_spec import job_of
    from .model import model_faces

    # A trimming polygon farther from its curve than the gouge tolerance would hide gouges at the border.
    part = model_faces(job, op.Base, op.GougeTolerance.Value)
    spec = job_of(op, part.machined, part.check)

    def call(**watching: Any) -> Any:
        return planning.plan(spec, faces=part.faces, **watching)

    plan = hooks.run(call)
    return plan, text(plan.report)


def require_native() -> None:
    """Raise NativeModuleMissing, with what to do, unless the native module can be used."""
    try:
        from .. import _core  # noqa: F401
    except ImportError as error:
        reason = f"the native module cannot be loaded ({error})"
        raise NativeModuleMissing(f"{reason}: build it with './dev build' in the add-on's folder") from None
