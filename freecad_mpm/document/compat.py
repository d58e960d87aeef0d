"""What differs between FreeCAD 0.20, 1.0 and 1.1: module names, tool bits, post-processors. Nothing else knows.

CAM's modules are attributes of this one (`compat.op_base`, ...), imported on first use: FreeCAD reads Init.py before CAM
can be imported."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import FreeCAD

VERSION = tuple(int(part) for part in FreeCAD.Version()[:2])
# 0.21 moved CAM's modules from the flat PathScripts to the tree Path.
FLAT_MODULES = VERSION < (0, 21)
# 1.1 keeps tools in an asset library and calls the bull nose's corner radius by its name.
ASSET_TOOLS = VERSION >= (1, 1)

# attribute of this module -> (name since 0.21, name in 0.20)
_MODULES = {
    "op_base": ("Path.Op.Base", "PathScripts.PathOp"),
    "op_gui": ("Path.Op.Gui.Base", "PathScripts.PathOpGui"),
    "job": ("Path.Main.Job", "PathScripts.PathJob"),
    "job_gui": ("Path.Main.Gui.Job", "PathScripts.PathJobGui"),
    "controller": ("Path.Tool.Controller", "PathScripts.PathToolController"),
    "util": ("Path.Base.Util", "PathScripts.PathUtil"),
    "preferences": ("Path.Preferences", "PathScripts.PathPreferences"),
    "utils": ("PathScripts.PathUtils", "PathScripts.PathUtils"),
}
# The two that have base classes of ours, named for the type checker.
op_base: Any
op_gui: Any


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return importlib.import_module(_MODULES[name][FLAT_MODULES])


def _module(name: str) -> Any:
    return __getattr__(name)


class Stateless:
    """Mixin of proxies that keep everything in properties: FreeCAD 0.20 asks by the first pair of names, newer by the
    second."""

    def __getstate__(self) -> None:
        return None

    def __setstate__(self, state: object) -> None:
        return None

    def dumps(self) -> None:
        return None

    def loads(self, state: object) -> None:
        return None


def torus_of(bit: Any) -> tuple[float, float]:
    """(cutter radius, corner radius) of a tool bit, mm. Raises ValueError when the bit is no bull nose or ball.

    FlatRadius, up to 1.0, is the radius of the flat bottom, not of the corner."""
    if not isinstance(getattr(bit, "Diameter", None), FreeCAD.Units.Quantity):
        raise ValueError("the tool must be a tool bit with a Diameter, not one of the old tool table")
    radius = float(bit.Diameter.Value) / 2
    if hasattr(bit, "CornerRadius"):
        return radius, float(bit.CornerRadius.Value)
    if hasattr(bit, "FlatRadius"):
        return radius, radius - float(bit.FlatRadius.Value)
    if _shape_name(bit) == "ballend":
        return radius, radius
    raise ValueError(
        f"tool '{bit.Label}' must be a bull nose or ball end, but its shape is '{_shape_name(bit)}'"
    )


def radii_of(bit: Any) -> tuple[float, float]:
    """The same of any tool bit with a diameter; one that is no bull nose or ball counts as an end mill."""
    try:
        return torus_of(bit)
    except ValueError:
        return float(bit.Diameter.Value) / 2, 0.0


def _shape_name(bit: Any) -> str:
    """The bit's shape in lower case without folder and ending, e.g. 'ballend'."""
    name = str(getattr(bit, "ShapeType", "") or getattr(bit, "BitShape", "") or "unknown")
    return name.replace("\\", "/").rsplit("/", 1)[-1].rsplit(".", 1)[0].lower()


def make_bull_nose(doc: Any, label: str, radius_mm: float, corner_mm: float) -> Any:
    """A new bull-nose tool bit in `doc`, which must be the active document."""
    bit = _bull_nose_from_assets(doc, label) if ASSET_TOOLS else _bull_nose_from_shape(label)
    bit.Diameter = 2 * radius_mm
    if hasattr(bit, "CornerRadius"):
        bit.CornerRadius = corner_mm
    else:
        bit.FlatRadius = radius_mm - corner_mm
    if bit.ViewObject:
        bit.ViewObject.Visibility = False
    return bit


def _bull_nose_from_assets(doc: Any, label: str) -> Any:
    from Path.Tool.toolbit import ToolBit

    attributes = {"version": 2, "name": label, "shape": "bullnose.fcstd", "shape-type": "Bullnose"}
    return ToolBit.from_dict(dict(attributes, parameter={}, attribute={})).attach_to_doc(doc=doc)


def _bull_nose_from_shape(label: str) -> Any:
    if FreeCAD.GuiUp:  # installs the factory that gives the bit its view provider
        importlib.import_module("PathScripts.PathToolBitGui" if FLAT_MODULES else "Path.Tool.Gui.Bit")
    bits = importlib.import_module("PathScripts.PathToolBit" if FLAT_MODULES else "Path.Tool.Bit")
    attributes = {"version": 2, "name": label, "shape": "bullnose.fcstd", "parameter": {}, "attribute": {}}
    return bits.Factory.CreateFromAttrs(attributes, label)


@contextmanager
def chosen(job: Any, controller: Any) -> Iterator[None]:
    """Answer CAM's questions for a job and a tool controller while an operation is made in one of several.

    Without the GUI CAM fails when there is a choice and nobody to ask."""
    utils = _module("utils")
    before = utils.UserInput
    utils.UserInput = _Answers(job, controller)
    try:
        yield
    finally:
        utils.UserInput = before


class _Answers:
    """The methods are CAM's."""

    def __init__(self, job: Any, controller: Any) -> None:
        self._job, self._controller = job, controller

    def selectedToolController(self) -> Any:
        return self._controller

    def chooseToolController(self, controllers: list[Any]) -> Any:
        return self._controller

    def chooseJob(self, jobs: list[Any]) -> Any:
        return self._job


def register_post_folder(folder: str) -> None:
    """Let CAM find the posts in `folder`. Calling it again changes nothing."""
    preferences = _module("preferences")
    if hasattr(preferences, "addAddonPostPath"):  # after 1.1
        preferences.addAddonPostPath(folder)
        return
    search = preferences.searchPathsPost
    if folder not in search():
        preferences.searchPathsPost = lambda: [*search(), folder]


def post_base() -> type | None:
    """CAM's base class of posts, or None where a post is a module with `export` (0.20)."""
    try:
        return importlib.import_module("Path.Post.Processor").PostProcessor
    except ImportError:
        return None


def show_job(job: Any) -> None:
    """Give a job that a script made what CAM's own command gives it in the GUI."""
    job.ViewObject.Proxy = _module("job_gui").ViewProvider(job.ViewObject)
    job.ViewObject.addExtension("Gui::ViewProviderGroupExtensionPython")
    job.ViewObject.Proxy.deleteOnReject = False
