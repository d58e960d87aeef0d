"""Verify: an operation's path cut into stock, and the result kept in the document.

The result is a record: it does not compute itself anew, but says when the path has changed since (`Outdated`). The class
name is written into documents: never rename it."""

from __future__ import annotations

import hashlib
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import FreeCAD
import Mesh
import numpy as np

from ..core.base import blame, write_atomically
from . import compat, hooks, program
from .computation import require_native
from .deviation import deviation_of, store
from .job_spec import job_of
from .messages import property_names
from .model import model_faces
from .properties import HIDDEN, READ_ONLY, Property

if TYPE_CHECKING:  # needs the native module
    from ..core.part import Scene
    from ..core.removal import Cut

NAME, STOCK = "Verification", "MachinedStock"
STOCK_LABEL = "Machined stock of {}"
RESULT_LABEL = "Verification of {}"
NO_MOVE = NO_POSITION = -1
# Properties of the worst places, in the order of `cutting.Worst`.
WORST = ("WorstGouge", "WorstRemainder", "WorstCheckGouge")

PROPERTIES = (
    Property("Operation", "Link", "Verification", "The operation whose path was cut", mode=READ_ONLY),
    Property("Stock", "Link", "Verification", "What the tool leaves of the stock", mode=READ_ONLY),
    Property("Resolution", "Length", "Verification", "Distance of the points looked at", 0.0, mode=READ_ONLY),
    Property(
        "Outdated", "Bool", "Verification", "The path has changed since: verify again", False, mode=READ_ONLY
    ),
    Property(
        "WorstGouge",
        "Distance",
        "Deviation",
        "Least deviation from the faces along their normals; negative: cut in",
        0.0,
        mode=READ_ONLY,
    ),
    Property("WorstGougePoint", "Vector", "Deviation", "Where that is", mode=READ_ONLY),
    Property("WorstGougeMove", "Integer", "Deviation", "The move that cut there; -1: none", mode=READ_ONLY),
    Property(
        "WorstRemainder", "Distance", "Deviation", "Most that remains above the faces", 0.0, mode=READ_ONLY
    ),
    Property("WorstRemainderPoint", "Vector", "Deviation", "Where that is", mode=READ_ONLY),
    Property(
        "WorstRemainderMove", "Integer", "Deviation", "The move that cut there last; -1: none", mode=READ_ONLY
    ),
    Property(
        "WorstCheckGouge",
        "Distance",
        "Deviation",
        "Deepest cut into a face that is not picked, negative; 0: none is cut",
        0.0,
        mode=READ_ONLY,
    ),
    Property("WorstCheckGougePoint", "Vector", "Deviation", "Where that is", mode=READ_ONLY),
    Property(
        "WorstCheckGougeMove",
        "Integer",
        "Deviation",
        "The move that went deepest; -1: none",
        -1,
        mode=READ_ONLY,
    ),
    Property(
        "Bands", "StringList", "Deviation", "What part of the faces deviates how much", [], mode=READ_ONLY
    ),
    Property("Tolerance", "Length", "Deviation", "How deep a cut of this path may be", 0.0, mode=READ_ONLY),
    Property(
        "Good", "Bool", "Deviation", "No face, picked or not, is cut deeper than that", False, mode=READ_ONLY
    ),
    Property("Data", "FileIncluded", "Stored", "Points, deviations, moves, triangles", mode=HIDDEN),
    Property("PathMark", "String", "Stored", "Tells one path from another", "", mode=HIDDEN),
)


class Verification(compat.Stateless):
    """Proxy of the result."""

    def __init__(self, obj: Any) -> None:
        obj.Proxy = self
        add_missing(obj)

    def onDocumentRestored(self, obj: Any) -> None:
        add_missing(obj)

    def execute(self, obj: Any) -> None:
        """Called when the operation has changed."""
        obj.Outdated = obj.Operation is None or obj.PathMark != path_mark(obj.Operation)


def add_missing(obj: Any) -> None:
    """Also to results of older versions; values that are there stay."""
    for one in PROPERTIES:
        if not hasattr(obj, one.name):
            obj.addProperty(f"App::Property{one.type}", one.name, one.group, one.doc)
            if one.default is not None:
                setattr(obj, one.name, one.default)
        obj.setEditorMode(one.name, one.mode)


@property_names()
def verify(op: Any, resolution_mm: float | None = None) -> Any:
    """Cut the operation's path into stock and return the result object: the operation's own, made when it has none.

    resolution_mm: distance of the points looked at; default: 300 along the part's longer side. The values themselves
    do not depend on it.

    Shows progress where there is a window. Raises InputError: no up-to-date path; Cancelled: nothing is changed.
    """
    require_native()
    from ..core import removal
    from ..core.removal import memory

    program.check_ready(op)
    scene = scene_of(op)
    resolution = resolution_mm or removal.default_resolution_mm(scene)
    with blame("Resolution:"):
        takes = memory.check(scene, resolution)
    FreeCAD.Console.PrintMessage(f"{op.Label}: {takes}\n")
    path = program.path_of([op])
    cut = hooks.run(lambda **watching: removal.cut(scene, path, resolution, **watching))
    result = result_of(op) or _make(op)
    _fill(result, op, cut)
    result.Document.recompute([result, result.Stock])
    return result


def result_of(op: Any) -> Any | None:
    """The operation's result, or None."""
    return next((obj for obj in op.Document.Objects if is_result(obj) and obj.Operation == op), None)


def is_result(obj: Any) -> bool:
    """Asked by class, so also of a result whose operation is gone."""
    return isinstance(getattr(obj, "Proxy", None), Verification)


def scene_of(op: Any) -> Scene:
    """The operation's faces and tool; part and set-up frame are FreeCAD's global frame."""
    from ..core.part import build_scene

    part = model_faces(compat.utils.findParentJob(op), op.Base, op.GougeTolerance.Value)
    return build_scene(job_of(op, part.machined, part.check), part.faces)


def allowed_depth_mm(op: Any) -> float:
    """How deep the operation's tolerances let a cut be."""
    from ..core import positioning
    from ..core.job import budget

    job = job_of(op, (), ())
    return budget.cut_depth_mm(job.tolerance, positioning.guarantee_of(job))


def position_at(op: Any, move: int) -> int:
    """Number in machining order, from 0, of the position in which a move of the path ends; NO_POSITION: in none."""
    from .playback import visited

    moves = visited(op).move
    number = int(np.searchsorted(moves, move))
    return number if number < len(moves) and moves[number] == move else NO_POSITION


def write_picture(result: Any, path: str) -> None:
    """Write the deviation map as PNG, whole or not at all. Works without a window."""
    from ..core.pictures import deviation
    from ..core.removal import bands as deviation_bands

    found = deviation_of(result)
    shown = deviation.Map(
        found.points,
        found.triangles,
        found.deviation_mm,
        found.measured,
        _extremes(result),
        result.Resolution.Value,
    )
    bands = deviation_bands.bands(result.Tolerance.Value)
    png = deviation.render(shown, bands, result.Label)
    write_atomically(path, png)


def _extremes(result: Any) -> list[Any]:
    """The worst places as `cutting.Worst` has them."""
    from ..core.removal import Extreme

    found = []
    for name in WORST:
        value, point = getattr(result, name).Value, np.array(tuple(getattr(result, f"{name}Point")))
        found.append(Extreme(value, point, getattr(result, f"{name}Move")))
    return [*found[:2], found[2] if found[2].deviation_mm < 0 else None]


def path_mark(op: Any) -> str:
    """The same for the same path, before and after saving."""
    return hashlib.sha256(op.Path.toGCode().encode()).hexdigest()


def _make(op: Any) -> Any:
    stock = op.Document.addObject("Mesh::Feature", STOCK)
    stock.Label = STOCK_LABEL.format(op.Label)
    result = op.Document.addObject("App::FeaturePython", NAME)
    Verification(result)
    result.Label = RESULT_LABEL.format(op.Label)
    result.Operation, result.Stock = op, stock
    hooks.present_result(result)
    return result


def _fill(result: Any, op: Any, cut: Cut) -> None:
    from ..core.removal import NOT_CUT
    from ..core.removal import bands as deviation_bands

    found, worst = cut.deviation, cut.worst()
    tolerance = allowed_depth_mm(op)
    bands = deviation_bands.bands(tolerance)
    result.Resolution, result.Tolerance = cut.resolution_mm, tolerance
    result.Good = cut.good(tolerance)
    for name, extreme in zip(WORST, (worst.gouge, worst.remainder, worst.check or NOT_CUT)):
        setattr(result, name, extreme.deviation_mm)
        setattr(result, f"{name}Point", FreeCAD.Vector(*extreme.point.tolist()))
        setattr(result, f"{name}Move", extreme.move)
    result.Bands = deviation_bands.table(bands, bands.shares(found.deviation_mm))
    result.PathMark, result.Outdated = path_mark(op), False
    store(result, cut)
    result.Stock.Mesh = _mesh(cut)


def _mesh(cut: Cut) -> Any:
    """As FreeCAD's mesh, by way of a file: a list of facets would take minutes."""
    from ..core.removal import mesh_file

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "stock.ply"
        file.write_bytes(mesh_file.to_bytes(file.name, *cut.mesh()))
        return Mesh.Mesh(str(file))
