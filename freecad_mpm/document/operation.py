"""Multi-Point Finish: the operation in a CAM job. The class names are written into documents: never rename them."""

from __future__ import annotations

from typing import Any

import FreeCAD
import Path

from ..core.base import Cancelled, InputError, one_line
from . import compat, properties, results
from .cl_path import Feeds, to_commands
from .computation import NativeModuleMissing, compute
from .messages import in_property_names

# What Problem says after the user stopped the computation.
CANCELLED = "cancelled"


class MultiPointFinish(compat.Stateless, compat.op_base.ObjectOp):
    """Finishes the faces in Base with a toroidal cutter that touches them at several points at once.

    The path holds the tool axis beside the tip (cl_path.py). When there is none, Problem says why."""

    def opFeatures(self, obj: Any) -> int:
        base = compat.op_base
        return base.FeatureTool | base.FeatureBaseFaces | base.FeatureCoolant

    def initOperation(self, obj: Any) -> None:
        properties.add_missing(obj)

    def opOnDocumentRestored(self, obj: Any) -> None:
        properties.add_missing(obj)

    def opExecute(self, obj: Any) -> None:
        """Compute the path. What is the user's to mend ends in Problem and no path, without a traceback."""
        try:
            plan, report = compute(obj, self.job)
        except NativeModuleMissing as error:
            _fail(obj, str(error))
            self.commandlist = list(obj.Path.Commands)  # computed where the module was, and still a path
        except Exception as error:
            _fail(obj, _problem(obj, error))
            results.clear(obj)
            obj.Path = Path.Path()
            if not isinstance(error, (InputError, Cancelled)):
                raise  # our bug: FreeCAD prints where
        else:
            obj.Problem = ""
            results.store(obj, plan, report)
            self.commandlist += to_commands(plan.path, Feeds(self.horizFeed, self.vertFeed))


def _problem(obj: Any, error: Exception) -> str:
    if isinstance(error, InputError):
        return in_property_names(str(error)).removeprefix(f"{obj.Label}: ")
    return (
        CANCELLED
        if isinstance(error, Cancelled)
        else f"internal error: {type(error).__name__}: {one_line(error)}"
    )


def _fail(obj: Any, problem: str) -> None:
    obj.Problem = problem
    FreeCAD.Console.PrintError(f"{obj.Label}: {problem}\n")


def create_operation(name: str, obj: Any = None, parentJob: Any = None) -> Any:
    """An operation in `parentJob` with default properties; CAM's signature for all of its operations."""
    obj = obj or FreeCAD.ActiveDocument.addObject("Path::FeaturePython", name)
    obj.Proxy = MultiPointFinish(obj, name, parentJob)
    return obj


def is_operation(obj: Any) -> bool:
    """Asked by class, so also of an operation that has no path."""
    return isinstance(getattr(obj, "Proxy", None), MultiPointFinish)
