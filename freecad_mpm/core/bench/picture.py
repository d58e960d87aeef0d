"""The picture of the comparison (bench.png): time, work, depth and contacts of each method on each surface."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..pictures import png_bytes
from .comparison import Row
from .summary import single_threaded

WIDTH_PX, HEIGHT_PX, DPI = 1400, 800, 100
# Colours that readers with colour-blindness tell apart (Okabe and Ito, 2008), one a surface.
COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00")
LEAST_DEPTH_MM = 1e-5  # the axis' foot: what cuts in less, or not at all, has no bar


def draw(rows: Sequence[Row]) -> bytes:
    """A PNG; one thread, where the rows have several counts."""
    rows = single_threaded(rows)
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.96, "Positions of one tool by each method, one thread", fontsize=14, weight="bold")
    panels = figure.subplots(
        2, 2, gridspec_kw=dict(left=0.07, right=0.98, top=0.88, bottom=0.08, hspace=0.35)
    )
    _bars(panels[0, 0], rows, "cpu_microseconds_per_position", "Time of a position", "µs", log=True)
    _bars(panels[0, 1], rows, "worst_gouge_mm", "Worst gouge (no bar: below 0.00001)", "mm", log=True)
    _bars(panels[1, 0], rows, "work", "Surface points or cells a position", "count", log=True)
    _bars(panels[1, 1], rows, "two_contacts", "Positions with two contacts", "share", log=False)
    panels[0, 1].set_ylim(bottom=LEAST_DEPTH_MM)
    surfaces = list(dict.fromkeys(row["surface"] for row in rows))
    figure.legend(
        panels[0, 0].containers, surfaces, loc="upper right", ncol=len(surfaces), frameon=False, fontsize=10
    )
    return png_bytes(figure)


def _bars(axes: Any, rows: Sequence[Row], key: str, title: str, unit: str, log: bool) -> None:
    methods = list(dict.fromkeys(row["method"] for row in rows))
    surfaces = list(dict.fromkeys(row["surface"] for row in rows))
    width = 0.8 / len(surfaces)
    for i, surface in enumerate(surfaces):
        values = {row["method"]: _value(row, key) for row in rows if row["surface"] == surface}
        at = np.arange(len(methods)) + (i - (len(surfaces) - 1) / 2) * width
        heights = [values.get(method, 0.0) for method in methods]
        axes.bar(at, heights, width, color=COLOURS[i % len(COLOURS)])
    axes.set_xticks(range(len(methods)), methods)
    if log:
        axes.set_yscale("log")
    axes.set_title(title, fontsize=11, loc="left")
    axes.set_ylabel(unit, fontsize=9)
    axes.tick_params(labelsize=9)
    axes.grid(axis="y", color="#E6E6E6", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def _value(row: Row, key: str) -> float:
    if key == "work":
        return float(row["evaluations_per_position"] + row["cells_per_position"])
    if key == "worst_gouge_mm":
        return max(row[key] or 0.0, LEAST_DEPTH_MM)
    return float(row[key])
