"""Pictures of a cut: the deviation as a map with its histogram, and sections."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from .cutting import Cut, Extreme
from .figure import png_bytes
from .section import Floats, Section

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
# The colours reach to these percentiles of the deviation; what lies beyond has the colour of the end.
SHOWN_PERCENT = (0.05, 99.5)
LEAST_SCALE_MM = 0.001  # of either side of the colours
BINS = 60
COLOUR_STEPS = 5
GOUGE, REMAINDER, MODELLED, MACHINED, PROBED = "#D01C1C", "#1B3A6B", "#777777", "#0072B2", "#E69F00"


def deviation_png(cut: Cut, title: str) -> bytes:
    """Map of the deviation seen along the set-up's z, its histogram, and the two worst places."""
    figure = _figure(title)
    norm = _norm(cut.deviation.deviation_mm)
    _map(figure, figure.add_axes((0.06, 0.08, 0.58, 0.84)), cut, norm)
    _histogram(figure.add_axes((0.74, 0.45, 0.24, 0.45)), cut.deviation.deviation_mm)
    _worst_lines(figure, cut)
    return _png(figure)


def section_png(one: Section, title: str, by_probe: Floats | None = None) -> bytes:
    """Above the modelled and the machined surface along the section, below their distance."""
    figure = _figure(title)
    shape, distance = figure.add_axes((0.07, 0.56, 0.9, 0.36)), figure.add_axes((0.07, 0.08, 0.9, 0.38))
    up = np.cross(one.direction, one.normal)
    for points, colour, name in ((one.points, MODELLED, "modelled"), (one.machined, MACHINED, "machined")):
        shape.plot(
            (points - one.origin) @ one.direction, points @ up, color=colour, linewidth=1.0, label=name
        )
    shape.legend(frameon=False, fontsize=9)
    _label(shape, "way along the section / mm", "height / mm")
    distance.plot(one.s_mm, one.deviation_mm, color=MACHINED, linewidth=1.0, label="along the normal")
    if by_probe is not None:
        distance.plot(one.s_mm, by_probe, color=PROBED, linewidth=1.0, label="by probe")
    distance.axhline(0.0, color=MODELLED, linewidth=0.8)
    distance.legend(frameon=False, fontsize=9)
    _label(distance, "way along the section / mm", "machined above modelled / mm")
    return _png(figure)


def _figure(title: str) -> Figure:
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.965, title, fontsize=14, weight="bold", va="center")
    return figure


def _png(figure: Figure) -> bytes:
    return png_bytes(figure)


def _norm(values: Floats) -> TwoSlopeNorm:
    low, high = np.percentile(values, SHOWN_PERCENT)
    return TwoSlopeNorm(0.0, min(low, -LEAST_SCALE_MM), max(high, LEAST_SCALE_MM))


def _map(figure: Figure, axes: Any, cut: Cut, norm: TwoSlopeNorm) -> None:
    found = cut.deviation
    at = cut.scene.frame.to_setup(found.points)
    colours = axes.tripcolor(
        at[:, 0], at[:, 1], found.triangles, found.deviation_mm, norm=norm, cmap="RdYlBu", shading="gouraud"
    )
    bar = figure.colorbar(colours, ax=axes, shrink=0.8, pad=0.02, extend="both")
    bar.set_ticks([norm.vmin, norm.vmin / 2, *np.linspace(0.0, norm.vmax, COLOUR_STEPS + 1)])
    bar.ax.set_yticklabels(
        [f"{value:+.4f}" if value < 0 else f"{value:.3f}" for value in bar.get_ticks()], fontsize=8
    )
    bar.set_label("deviation / mm (below 0: cut in, above: left over)", fontsize=9)
    worst = cut.worst()
    for extreme, colour in ((worst.gouge, GOUGE), (worst.remainder, REMAINDER)):
        x, y, _ = cut.scene.frame.to_setup(extreme.point)
        axes.plot([x], [y], marker="+", markersize=14, markeredgewidth=2.0, color=colour)
    axes.set_aspect("equal")
    _label(axes, "set-up x / mm", "set-up y / mm")


def _histogram(axes: Any, values: Floats) -> None:
    low, high = min(float(values.min()), -LEAST_SCALE_MM), float(np.percentile(values, SHOWN_PERCENT[1]))
    _, edges, bars = axes.hist(
        np.minimum(values, high), bins=np.linspace(low, max(high, LEAST_SCALE_MM), BINS + 1)
    )
    for edge, bar in zip(edges, bars):
        bar.set_facecolor(GOUGE if edge < 0 else MACHINED)
    axes.set_yscale("log")
    axes.set_title("How many points deviate how much", fontsize=10, loc="left")
    _label(axes, "deviation / mm", "points")


def _worst_lines(figure: Figure, cut: Cut) -> None:
    worst = cut.worst()
    for y, name, extreme, colour in (
        (0.30, "Worst gouge", worst.gouge, GOUGE),
        (0.18, "Largest remainder", worst.remainder, REMAINDER),
    ):
        figure.text(
            0.72, y, f"+  {name}: {extreme.deviation_mm:+.4f} mm", color=colour, fontsize=11, weight="bold"
        )
        figure.text(0.735, y - 0.03, _place(extreme), fontsize=10)
    figure.text(
        0.72, 0.07, f"{len(cut.deviation.points)} points, every {cut.resolution_mm:g} mm", fontsize=10
    )


def _place(extreme: Extreme) -> str:
    x, y, z = extreme.point
    after = f"after move {extreme.move}" if extreme.move >= 0 else "no move cut there"
    return f"at {x:.2f} {y:.2f} {z:.2f}, {after}"


def _label(axes: Any, x: str, y: str) -> None:
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.tick_params(labelsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
