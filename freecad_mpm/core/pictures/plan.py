"""The picture of a plan (path.png): the part with its passes in space, and how good the positions are."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path
from typing import Any

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import write_atomically
from ..part import FaceArrays
from ..planning import Plan
from . import plan_panels, plan_scene
from .figure import png_bytes

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100


def draw(plan: Plan, faces: Sequence[FaceArrays], path: str | Path, **options: Any) -> None:
    """Write the PNG of `render` to `path`, whole or not at all. Raises InputError when it cannot be written."""
    write_atomically(path, render(plan, faces, **options))


def render(
    plan: Plan,
    faces: Sequence[FaceArrays],
    *,
    machined: Collection[str] | None = None,
    gouge_mm: float = 0.001,
    title: str = "",
) -> bytes:
    """A PNG of 1600 x 1000 pixels.

    plan:     its positions and `path`, in the part's frame.
    faces:    of the part, in its frame. machined: names of those to machine, the others are drawn paler (None: all).
    gouge_mm: positions that cut deeper count, and are marked, as gouges."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.965, title, fontsize=14, weight="bold", va="center")
    scene = figure.add_axes((0.0, 0.0, 0.68, 0.95), projection="3d", computed_zorder=False)
    plan_scene.fill(scene, plan, faces, machined, gouge_mm)
    plan_panels.tilt(figure.add_axes((0.735, 0.665, 0.245, 0.265)), plan)
    plan_panels.clearance(figure.add_axes((0.735, 0.335, 0.245, 0.245)), plan, gouge_mm)
    plan_panels.key(figure.add_axes((0.70, 0.02, 0.29, 0.25)), plan, gouge_mm)
    return png_bytes(figure)
