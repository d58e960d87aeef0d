"""The picture's view in space: shaded faces, passes, links, tool axes and contacts."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection  # type: ignore[import]

from ..base import Flags, Floats
from ..part import FaceArrays, quads
from ..planning import Plan
from . import style

QUAD_BUDGET = 30_000
AXES_SHOWN = 260  # about so many tool axes are drawn
AXIS_LENGTH = 0.07  # of the scene's diagonal
ELEVATION_DEG, AZIMUTH_DEG = 38.0, -58.0
AMBIENT = 0.6  # light on a quad that stands edge-on to the lamp
BRIGHTEST = 1.05
LAMP = np.array([-0.8, -0.3, 0.55])  # from the part, z up as in the picture


def fill(
    axes: Any, plan: Plan, faces: Sequence[FaceArrays], machined: Collection[str] | None, gouge_mm: float
) -> None:
    """Draw into 3D `axes`; what is drawn later covers what was drawn before, as seen from the tool's side."""
    upright = _upright(plan)
    patches = quads(faces, QUAD_BUDGET)
    _set_view(axes, plan, patches, upright)
    _add_faces(axes, [_colour(face, machined) for face in faces], patches, upright)
    _add_links(axes, plan)
    _add_tool_axes(axes, plan)
    _add_cuts(axes, plan)
    _add_contacts(axes, plan)
    _add_gouges(axes, plan, gouge_mm)


def _upright(plan: Plan) -> Floats:
    """The signed coordinate direction nearest to the mean tool axis: the picture's up."""
    axis = plan.path.axis
    mean = axis.mean(axis=0) if len(axis) else np.array([0.0, 0.0, 1.0])
    up = np.zeros(3)
    dominant = int(np.argmax(np.abs(mean)))
    up[dominant] = np.sign(mean[dominant]) or 1.0
    return up


def _set_view(axes: Any, plan: Plan, patches: Sequence[Floats], upright: Floats) -> None:
    points = np.concatenate([*(corners.reshape(-1, 3) for corners in patches), plan.path.tip])
    lo, hi = points.min(axis=0), points.max(axis=0)
    size = np.maximum(hi - lo, (hi - lo).max() / 100)
    axes.set(xlim=(lo[0], lo[0] + size[0]), ylim=(lo[1], lo[1] + size[1]), zlim=(lo[2], lo[2] + size[2]))
    vertical = int(np.argmax(np.abs(upright)))
    # Matplotlib turns the box with the vertical axis, but not its proportions.
    axes.set_box_aspect(np.roll(size, 2 - vertical), zoom=1.12)
    axes.view_init(ELEVATION_DEG * upright[vertical], AZIMUTH_DEG, vertical_axis="xyz"[vertical])
    axes.set_xlabel("x / mm")
    axes.set_ylabel("y / mm")
    axes.set_zlabel("z / mm", labelpad=-2)
    axes.tick_params(labelsize=8)
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color((0.985, 0.985, 0.985, 1.0))
        axis._axinfo["grid"].update(color=(0.88, 0.88, 0.88, 1.0), linewidth=0.5)


def _colour(face: FaceArrays, machined: Collection[str] | None) -> tuple[float, float, float]:
    return style.FACE if machined is None or face.name in machined else style.CHECK_FACE


def _add_faces(
    axes: Any, colours: Sequence[tuple[float, float, float]], patches: Sequence[Floats], upright: Floats
) -> None:
    """All faces as one collection: only within a collection does Matplotlib draw what is farther away first."""
    shades = [
        np.clip(np.outer(_light(corners, upright), colour), 0.0, 1.0)
        for colour, corners in zip(colours, patches)
    ]
    corners, shade = np.concatenate(list(patches)), np.concatenate(shades)
    axes.add_collection3d(
        Poly3DCollection(corners, facecolors=shade, edgecolors=shade, linewidths=0.3, zorder=1)
    )


def _light(corners: Floats, upright: Floats) -> Floats:
    """(Q,): brightness of each quad, the side towards the tool lit."""
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    length = np.linalg.norm(normal, axis=1)
    normal = np.divide(
        normal, length[:, None], out=np.tile(upright, (len(normal), 1)), where=length[:, None] > 0
    )
    normal *= np.where(normal @ upright < 0, -1.0, 1.0)[:, None]
    vertical = int(np.argmax(np.abs(upright)))
    lamp = np.roll(LAMP * [1.0, 1.0, upright[vertical]], vertical - 2)
    lit: Floats = np.clip(normal @ (lamp / np.linalg.norm(lamp)), 0.0, 1.0)
    return AMBIENT + (BRIGHTEST - AMBIENT) * lit


def _segments(plan: Plan, chosen: Flags) -> Floats:
    """(S, 2, 3): the chosen moves' lines of the tip; the first move has no start."""
    ends = np.flatnonzero(chosen)
    ends = ends[ends > 0]
    return np.stack([plan.path.tip[ends - 1], plan.path.tip[ends]], axis=1)


def _add_lines(axes: Any, segments: Floats, zorder: int, **looks: Any) -> None:
    if len(segments):
        axes.add_collection3d(Line3DCollection(segments, zorder=zorder, **looks))


def _add_links(axes: Any, plan: Plan) -> None:
    for kind, (colour, dashes) in style.LINK_STYLES.items():
        segments = _segments(plan, (plan.path.kind == kind) & ~plan.path.blocked)
        _add_lines(axes, segments, 2, colors=colour, linestyles=[dashes], linewidths=0.8)
    _add_lines(axes, _segments(plan, plan.path.blocked), 6, colors=style.GOUGE, linewidths=1.8)


def _add_tool_axes(axes: Any, plan: Plan) -> None:
    shown = style.visited(plan)
    shown = shown[:: max(1, round(len(shown) / AXES_SHOWN))]
    size = np.linalg.norm([np.diff(limits) for limits in (axes.get_xlim(), axes.get_ylim(), axes.get_zlim())])
    tips = plan.tip[shown]
    ticks = np.stack([tips, tips + AXIS_LENGTH * size * plan.axis[shown]], axis=1)
    _add_lines(axes, ticks, 4, colors=style.AXIS, linewidths=0.6, alpha=0.55)


def _add_cuts(axes: Any, plan: Plan) -> None:
    """The tip's way in the colour of the status of the position that the cut ends in."""
    ends_in = np.where(plan.path.position >= 0, plan.status[plan.path.position], "")
    for status in np.unique(ends_in):
        segments = _segments(plan, (plan.path.kind == "cut") & (ends_in == status))
        _add_lines(axes, segments, 5, colors=style.status_colour(str(status)), linewidths=1.6)


def _add_contacts(axes: Any, plan: Plan) -> None:
    points = plan.contacts[style.visited(plan)]
    for which, colour in ((0, style.FIRST_CONTACT), (1, style.SECOND_CONTACT)):
        axes.scatter(
            *points[:, which].T,
            s=5,
            c=colour,
            edgecolors="#00000055",
            linewidths=0.25,
            depthshade=False,
            zorder=3,
        )


def _add_gouges(axes: Any, plan: Plan, gouge_mm: float) -> None:
    tips = plan.tip[style.gouging(plan.positions, gouge_mm) & np.isfinite(plan.tip).all(axis=1)]
    axes.scatter(
        *tips.T, s=14, facecolors="none", edgecolors=style.GOUGE, linewidths=0.9, depthshade=False, zorder=7
    )
