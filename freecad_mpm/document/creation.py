"""`freecad_mpm.create`: an operation on picked faces, in a Job that is made when there is none."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import FreeCAD

from ..core.base import TOOLS, Cancelled, InputError
from ..core.job import DEFAULT_POST, PostSpec, ToolSpec
from ..core.job import tool as tools
from . import compat, hooks, properties
from .computation import require_native
from .model import base_of, model_of, picked_faces, public_object
from .operation import CANCELLED, create_operation
from .posts import register

OPERATION = "MultiPointFinish"
# Feeds and speed of a tool controller made here; CAM's own start at zero, with which nothing moves.
USUAL = PostSpec()
# The shipped tool that is taken when neither the caller nor the job has one.
DEFAULT_TOOL = "thesis"
# A tool bit keeps its diameter and flat radius in decimals; radii this near are the same tool.
SAME_RADIUS_MM = 1e-6


def create(
    doc: Any,
    faces: Iterable[Any],
    *,
    job: Any = None,
    tool_controller: Any = None,
    major_radius_mm: float | None = None,
    minor_radius_mm: float | None = None,
    **values: Any,
) -> Any:
    """Make a Multi-Point Finish operation on `faces`, compute it, and return it.

    doc:             the document; it becomes the active one.
    faces:           pairs (object, "Face1") or (object, ("Face1", "Face2")), or getSelectionEx().
    job:             the CAM job; default: the one with the faces' objects in its model, else a new one.
    tool_controller: of the job, with a bull nose or ball end; default: one of the job with the radii that follow
                     (any, when none are given), else a new one: with those radii, or the shipped hollow cutter.
    major_radius_mm: of the circle on which the torus' centres lie.
    minor_radius_mm: of the torus, that is the corner.
    values:          the operation's properties by name, e.g. SideStep="18 mm".

    Raises InputError in one line, or Cancelled; what was made until then stays, for the caller's transaction to undo.
    """
    require_native()
    picked = picked_faces(faces)
    _check_names(values)
    FreeCAD.setActiveDocument(doc.Name)
    job = job or _job_with(doc, [obj for obj, _ in picked]) or _make_job(doc, picked)
    radii = major_radius_mm, minor_radius_mm
    controller = tool_controller or _find_controller(job, *radii)
    if controller is None:
        tool = _new_tool(*radii)
        controller = _make_controller(job, tool)
        values.setdefault("Recess", tool.recess_mm)  # CAM's tools know of no hollow
    op = _make_operation(job, controller)
    op.Base = base_of(job, picked)
    for name, value in values.items():
        _assign(op, name, value)
    doc.recompute()
    if op.Problem:
        raise Cancelled() if op.Problem == CANCELLED else InputError(op.Problem)
    return op


def _check_names(values: dict[str, Any]) -> None:
    known = [one.name for one in properties.settings()]
    for name in values:
        if name not in known:
            raise InputError(f"{name}: no such property; there are {', '.join(known)}")


def _assign(op: Any, name: str, value: Any) -> None:
    choices = op.getEnumerationsOfProperty(name)
    if choices and value not in choices:
        raise InputError(f"{name}: must be one of {', '.join(choices)}, got {value!r}")
    try:
        setattr(op, name, value)
    except (TypeError, ValueError, RuntimeError):  # FreeCAD's errors are RuntimeErrors
        kind = op.getTypeIdOfProperty(name).removeprefix("App::Property").lower()
        raise InputError(
            f"{name}: must be a {kind}, with its unit when it is a text, got {value!r}"
        ) from None


def _job_with(doc: Any, objects: list[Any]) -> Any | None:
    """The first job of the document whose model has all of `objects`, or None."""
    for job in compat.job.Instances():
        if job.Document == doc and all(model_of(job, obj) is not None for obj in objects):
            return job
    return None


def _make_job(doc: Any, picked: list[tuple[Any, str]]) -> Any:
    register()
    objects = list(dict.fromkeys(public_object(obj) for obj, _ in picked))
    job = compat.job.Create("Job", objects, None)
    job.PostProcessor = DEFAULT_POST
    # A clone knows nothing of the parts that hold its original.
    for model, obj in zip(job.Model.Group, objects):
        model.Placement = obj.getGlobalPlacement()
    _remove_default_tools(job)
    if FreeCAD.GuiUp:
        compat.show_job(job)
    return job


def _remove_default_tools(job: Any) -> None:
    """A new job has a flat end mill, with which no operation of ours can work."""
    for controller in list(job.Tools.Group):
        controller.Proxy.onDelete(controller)
        job.Document.removeObject(controller.Name)


def _find_controller(job: Any, major_mm: float | None, minor_mm: float | None) -> Any | None:
    """A controller of the job whose tool has those radii (None: any toroidal one), or None."""
    return next((one for one in job.Tools.Group if _fits(one, major_mm, minor_mm)), None)


def _fits(controller: Any, major_mm: float | None, minor_mm: float | None) -> bool:
    try:
        radius, corner = compat.torus_of(controller.Tool)
    except ValueError:
        return False
    same_major = major_mm is None or abs(radius - corner - major_mm) <= SAME_RADIUS_MM
    return corner > 0 and same_major and (minor_mm is None or abs(corner - minor_mm) <= SAME_RADIUS_MM)


def _new_tool(major_mm: float | None, minor_mm: float | None) -> ToolSpec:
    """The shipped tool, or one with the radii that are given."""
    shipped = tools.load(TOOLS / f"{DEFAULT_TOOL}.toml")
    if major_mm is None and minor_mm is None:
        return shipped
    return ToolSpec(
        major_radius_mm=shipped.major_radius_mm if major_mm is None else major_mm,
        minor_radius_mm=shipped.minor_radius_mm if minor_mm is None else minor_mm,
    )


def _make_controller(job: Any, tool: ToolSpec) -> Any:
    label = tool.name or f"Bull nose D{2 * tool.radius_mm:g} R{tool.minor_radius_mm:g}"
    bit = compat.make_bull_nose(job.Document, label, tool.radius_mm, tool.minor_radius_mm)
    bit.CuttingEdgeHeight = tool.flute_length_mm
    bit.Length = tool.flute_length_mm + sum(one.length_mm for one in tool.shank)
    bit.ShankDiameter = 2 * (tool.shank[0].bottom_radius_mm if tool.shank else tool.radius_mm)
    controller = compat.controller.Create(f"TC: {label}", tool=bit, toolNumber=job.Proxy.nextToolNumber())
    controller.HorizFeed = f"{USUAL.cut_feed_mm_per_min} mm/min"
    controller.VertFeed = f"{USUAL.plunge_feed_mm_per_min} mm/min"
    controller.SpindleSpeed = USUAL.spindle_rpm
    job.Proxy.addToolController(controller)
    return controller


def _make_operation(job: Any, controller: Any) -> Any:
    with compat.chosen(job, controller):
        op = create_operation(OPERATION, parentJob=job)
    op.ToolController = controller
    hooks.present(op)
    return op
