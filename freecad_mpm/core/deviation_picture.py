"""The deviation map as a picture: the machined faces from above in the colours of their bands."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy.typing import NDArray

from . import deviation_bands
from .deviation_bands import Bands
from .figure import png_bytes

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

WIDTH_PX, HEIGHT_PX, DPI = 1400, 900, 100
GOUGE_MARK, REMAINDER_MARK = "#7A0019", "#0B2A63"


def render(points: Floats, triangles: Integers, deviation_mm: Floats, bands: Bands, title: str) -> bytes:
    """A PNG of 1400 x 900 pixels.

    points (N, 3): set-up frame, seen from +z; triangles (T, 3) of them; deviation_mm (N,): along
    the normal, + remains. A triangle has the colour of its worst corner: a gouge anywhere before what remains.
    """
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.03, 0.955, title, fontsize=14, weight="bold")
    axes = figure.add_axes((0.06, 0.07, 0.62, 0.86))
    band = bands.of(deviation_mm)
    _fill(axes, points, triangles, band[triangles].min(axis=1))
    _mark(axes, points, deviation_mm)
    _key(figure, bands, bands.shares(deviation_mm))
    return png_bytes(figure)


def _fill(axes: Any, points: Floats, triangles: Integers, band: Integers) -> None:
    height = points[triangles, 2].mean(axis=1)
    order = np.argsort(height, kind="stable")  # what lies higher covers what lies lower
    colours = np.array(deviation_bands.COLOURS)[band[order]]
    corners = points[triangles[order], :2]
    axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.3))
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_xlabel("x / mm")
    axes.set_ylabel("y / mm")


def _mark(axes: Any, points: Floats, deviation_mm: Floats) -> None:
    gouge, remainder = int(np.argmin(deviation_mm)), int(np.argmax(deviation_mm))
    for at, marker, colour, what in (
        (gouge, "v", GOUGE_MARK, "least"),
        (remainder, "^", REMAINDER_MARK, "most"),
    ):
        label = f"{what}: {deviation_bands.length(deviation_mm[at])}"
        looks = {"marker": marker, "markersize": 11, "color": colour, "markeredgecolor": "white"}
        axes.plot(*points[at, :2], linestyle="", label=label, **looks)
    axes.figure.legend(loc="center left", bbox_to_anchor=(0.70, 0.24), frameon=False, fontsize=11)


def _key(figure: Any, bands: Bands, shares: list[float]) -> None:
    rows = zip(bands.names, deviation_bands.COLOURS, shares)
    handles = [
        Patch(color=colour, label=f"{name}: {deviation_bands.share(part)}") for name, colour, part in rows
    ]
    title = "Deviation along the normal\n(+ remains, − is cut in)"
    figure.legend(
        handles=handles,
        loc="center left",
        bbox_to_anchor=(0.70, 0.5),
        title=title,
        frameon=False,
        fontsize=11,
    )
