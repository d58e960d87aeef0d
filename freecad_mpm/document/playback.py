"""Playing back an operation's stored path: nothing is computed anew but the machine's joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.base import Floats, write_together
from . import compat, program
from .computation import require_native
from .job_spec import job_of, tool_of
from .messages import property_names
from .model import model_faces
from .results import NO_STATUS

if TYPE_CHECKING:  # needs the native module
    from ..core.job import ToolSpec
    from ..core.part import FaceArrays
    from ..core.playback import Playback


@dataclass(frozen=True)
class Played:
    """What playback shows of an operation; the set-up frame is FreeCAD's global frame."""

    playback: Playback
    tool: ToolSpec
    part_box: tuple[Floats, Floats]


@property_names()
def played(op: Any) -> Played:
    """The playback of an operation on its own machine. Raises InputError when it has no up-to-date path."""
    require_native()
    from ..core.machine import move_machine
    from ..core.playback import playback
    from ..core.program import find_shop

    program.check_ready(op)
    job = job_of(op, (), ())
    place = find_shop(job)
    blocks = move_machine(job, place.machine, program.path_of([op]))
    made = playback.make_playback(place.machine, blocks, visited(op))
    return Played(made, tool_of(op), _model_box(op))


def visited(op: Any) -> Any:
    """The positions of the stored path as core.playback.Visited."""
    from ..core.playback import Visited

    code = np.array(op.MoveStatus, dtype=int)
    moves = np.flatnonzero(code != NO_STATUS)
    clearance = np.array(op.PositionClearance, dtype=float)
    if len(clearance) != len(moves):  # of a document from before there were any
        clearance = np.full(len(moves), np.nan)
    return Visited(moves, np.array(op.StatusNames)[code[moves]], clearance)


def write_pictures(op: Any, numbers: Sequence[int], folder: str) -> list[str]:
    """Write a PNG of tool and machine at each of these positions, in machining order from 1, to `folder`.

    Returns the files' paths. Works without a window. Raises InputError: no path, no such position, no such folder.
    """
    from ..core.pictures import playback as playback_picture

    shown = played(op)
    files = playback_picture.of_positions(shown.playback, numbers, part_faces(op), shown.tool)
    return [str(path) for path in write_together(folder, files)]


def part_faces(op: Any) -> list[FaceArrays]:
    """The faces of the job's model, those to machine first."""
    part = model_faces(compat.utils.findParentJob(op), op.Base, op.GougeTolerance.Value)
    machined = set(part.machined)
    return sorted(part.faces, key=lambda face: face.name not in machined)


def _model_box(op: Any) -> tuple[Floats, Floats]:
    from .faces import global_shape

    boxes = [global_shape(model).BoundBox for model in compat.utils.findParentJob(op).Model.Group]
    low = np.min([(box.XMin, box.YMin, box.ZMin) for box in boxes], axis=0)
    high = np.max([(box.XMax, box.YMax, box.ZMax) for box in boxes], axis=0)
    return low, high
