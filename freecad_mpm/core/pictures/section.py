"""A section as a picture, as the thesis' figures 5.3 and 5.5 show theirs."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import Floats
from ..removal import Section
from .figure import dress, png_bytes

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
MODELLED, MACHINED, PROBED = "#777777", "#0072B2", "#E69F00"
WAY = "way along the section / mm"


def render(one: Section, title: str, by_probe: Floats | None = None) -> bytes:
    """Above the modelled and the machined surface in the plane, below their distance: over the way along the plane, or
    along the curve where that turns back."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.965, title, fontsize=14, weight="bold", va="center")
    _shape(figure.add_axes((0.07, 0.56, 0.9, 0.35)), one)
    _distance(figure.add_axes((0.07, 0.08, 0.9, 0.38)), one, by_probe)
    return png_bytes(figure)


def _shape(axes: Any, one: Section) -> None:
    for points, colour, name in ((one.points, MODELLED, "modelled"), (one.machined, MACHINED, "machined")):
        offset = points - one.plane.origin
        axes.plot(
            *_broken(one, offset @ one.plane.along, offset @ one.plane.up),
            color=colour,
            linewidth=1.0,
            label=name,
        )
    axes.legend(frameon=False, fontsize=9)
    if not _is_graph(one):
        axes.set_aspect("equal", adjustable="datalim")
    dress(axes, "In the plane", WAY, "across it / mm")


def _distance(axes: Any, one: Section, by_probe: Floats | None) -> None:
    graph = _is_graph(one)
    way = one.s_mm if graph else one.way_mm
    axes.plot(*_broken(one, way, one.deviation_mm), color=MACHINED, linewidth=1.0, label="along the normal")
    if by_probe is not None:
        axes.plot(*_broken(one, way, by_probe), color=PROBED, linewidth=1.0, label="by probe")
    axes.axhline(0.0, color=MODELLED, linewidth=0.8)
    axes.legend(frameon=False, fontsize=9)
    dress(axes, "Deviation", WAY if graph else "way along the curve / mm", "machined above modelled / mm")


def _is_graph(one: Section) -> bool:
    """No two points of the section lie over one another."""
    return bool((np.diff(one.s_mm) >= 0).all())


def _broken(one: Section, x: Floats, y: Floats) -> tuple[Floats, Floats]:
    """The same lines with a gap between two pieces."""
    gaps = np.flatnonzero(np.diff(one.piece)) + 1
    return np.insert(x, gaps, np.nan), np.insert(y, gaps, np.nan)
