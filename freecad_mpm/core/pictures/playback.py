"""A picture of the tool and the machine at one position: beside it what playback shows in words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection  # type: ignore[import]

from .. import machine
from ..base import Floats, InputError
from ..job import ToolSpec
from ..part import FaceArrays, quads
from ..planning import Plan
from ..playback import (
    PART,
    TOOL,
    TOOL_COLOURS,
    Colour,
    Playback,
    Visited,
    colour_of,
    describe,
    make_playback,
    sketch,
    table_letters,
    tool_solid,
)
from . import style
from .figure import png_bytes


def playback_of(plan: Plan) -> Playback:
    """The playback of a plan, on the machine of its job."""
    moves = np.flatnonzero(plan.path.position >= 0)
    position = plan.path.position[moves]
    visited = Visited(moves, plan.status[position], plan.clearance[position, 1])
    return make_playback(machine.load(plan.job.machine.name), plan.joints, visited)


WIDTH_PX, HEIGHT_PX, DPI = 1600, 800, 100
QUAD_BUDGET = 12_000
ELEVATION_DEG, AZIMUTH_DEG = 18.0, -62.0
LAMP = np.array([-0.5, -0.62, 0.6])  # from the scene
AMBIENT = 0.55
# Facets longer than this part of their body are cut up: what hides what is decided by their middles.
FACET_LENGTH = 0.06


def of_plan(plan: Plan, numbers: Sequence[int]) -> dict[str, bytes | str]:
    """File name -> PNG of the positions with these numbers, in machining order from 1.

    Raises InputError for a number that no position has."""
    faces = [face.transformed(plan.scene.frame) for face in (*plan.scene.machined, *plan.scene.check)]
    return of_positions(playback_of(plan), numbers, faces, plan.job.tool)


def of_positions(
    played: Playback, numbers: Sequence[int], faces: Sequence[FaceArrays], tool: ToolSpec
) -> dict[str, bytes | str]:
    """As `of_plan`, with the part's faces in the set-up frame."""
    count = len(played.visited.move)
    for number in numbers:
        if not 1 <= number <= count:
            raise InputError(f"position {number}: must be from 1 to {count}")
    return {
        f"position_{number:06d}.png": render(played, played.at_position(number - 1), faces, tool)
        for number in numbers
    }


def render(played: Playback, place: float, faces: Sequence[FaceArrays], tool: ToolSpec) -> bytes:
    """A PNG of 1600 x 800 pixels: left the tool on the part, right the machine with the part on its table.

    faces: of the part, in the set-up frame. place: as in Playback."""
    moment = played.moment(place)
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    part = [patch.reshape(-1, 4, 3) for patch in quads(faces, QUAD_BUDGET)]
    bodies = played.body_matrices(moment, part_fixed=True)
    on_part = figure.add_axes((0.0, 0.0, 0.40, 1.0), projection="3d", computed_zorder=False)
    _fill(on_part, [*_part(part, np.eye(4)), *_tool(tool, bodies)])
    bodies = played.body_matrices(moment, part_fixed=False)
    box = _box(part)
    on_machine = figure.add_axes((0.40, 0.0, 0.40, 1.0), projection="3d", computed_zorder=False)
    machine = _machine(played, box, tool, bodies)
    _fill(on_machine, [*_part(part, bodies[PART]), *_tool(tool, bodies), *machine])
    words = "\n".join(f"{name}: {value}" for name, value in describe(played, place).items())
    figure.text(0.81, 0.90, words, fontsize=12, va="top", linespacing=1.5)
    return png_bytes(figure)


def _part(patches: Sequence[Floats], matrix: Floats) -> list[tuple[Floats, Colour]]:
    return [(_moved(patch, matrix), style.FACE) for patch in patches]


def _tool(tool: ToolSpec, bodies: Mapping[str, Floats]) -> list[tuple[Floats, Colour]]:
    matrix = bodies[TOOL]
    return [
        (_moved(_cut_up(mesh), matrix), TOOL_COLOURS[name]) for name, mesh in tool_solid.meshes(tool).items()
    ]


def _machine(
    played: Playback, box: tuple[Floats, Floats], tool: ToolSpec, bodies: Mapping[str, Floats]
) -> list[tuple[Floats, Colour]]:
    tables = table_letters(played.machine)
    return [
        (_moved(_cut_up(mesh), bodies[name]), colour_of(name, tables))
        for name, mesh in sketch.sketch(played.machine, box, tool).items()
    ]


def _moved(corners: Floats, matrix: Floats) -> Floats:
    return np.asarray(corners @ matrix[:3, :3].T + matrix[:3, 3])


def _cut_up(mesh: tool_solid.Mesh) -> Floats:
    """The mesh's triangles (T, 3, 3), halved at their longest edges until none is long."""
    longest = FACET_LENGTH * float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
    corners, done = mesh.corners, []
    while len(corners):
        edges = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
        is_long = edges.max(axis=1) > longest
        done.append(corners[~is_long])
        first = edges[is_long].argmax(axis=1)  # the longest edge runs from this corner to the next
        a, b, c = (corners[is_long][np.arange(len(first)), (first + i) % 3] for i in range(3))
        middle = (a + b) / 2
        corners = np.concatenate((np.stack((a, middle, c), axis=1), np.stack((middle, b, c), axis=1)))
    return np.concatenate(done)


def _box(patches: Sequence[Floats]) -> tuple[Floats, Floats]:
    points = np.concatenate([patch.reshape(-1, 3) for patch in patches])
    return points.min(axis=0), points.max(axis=0)


def _fill(axes: Any, pieces: Sequence[tuple[Floats, Colour]]) -> None:
    """One collection a kind of polygon would not sort between them: triangles become quadrilaterals."""
    corners = np.concatenate([_as_quads(corners) for corners, _ in pieces])
    colours = np.concatenate([_shaded(corners, colour) for corners, colour in pieces])
    looks = {"facecolors": colours, "edgecolors": colours, "linewidths": 0.2, "clip_on": False}
    axes.add_collection3d(Poly3DCollection(corners, **looks))
    points = corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.15)
    axes.view_init(ELEVATION_DEG, AZIMUTH_DEG)
    axes.set_axis_off()


def _as_quads(corners: Floats) -> Floats:
    return corners if corners.shape[1] == 4 else np.concatenate((corners, corners[:, 2:]), axis=1)


def _shaded(corners: Floats, colour: Colour) -> Floats:
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    facing = np.abs(np.divide(normal, length, out=np.zeros_like(normal), where=length > 0) @ LAMP)
    light = AMBIENT + (1 - AMBIENT) * facing / np.linalg.norm(LAMP)
    return np.clip(np.outer(light, colour), 0.0, 1.0)
