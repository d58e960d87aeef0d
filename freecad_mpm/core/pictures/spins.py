"""Pictures: the spread over all spins (spins.png), and contact spacing with and without control (spacing.png)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..base import Floats
from ..planning import Plan
from ..positioning import Spread, spacing
from .figure import dress, png_bytes

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
COLOURS = "viridis"
MISSED = "#D01C1C"


def draw_spread(found: Spread, along: Floats, title: str) -> bytes:
    """A PNG: across and direct spacing, strip width and tilt over the spin, and where Q goes round P in plan."""
    figure = _figure(title)
    colours = colormaps[COLOURS](np.linspace(0.0, 0.9, max(len(found.points), 1)))
    panels = [
        (found.direct, "|PQ| / mm", "Distance of the contacts"),
        (found.across, "across the feed / mm", "The same, seen along the feed"),
        (found.strip, "width / mm", f"Strip within {found.scallop_mm * 1000:g} µm of the tool"),
        (np.degrees(np.arccos(np.clip(found.axis[..., 2], -1, 1))), "angle / °", "Tool axis against z"),
    ]
    for place, (values, label, heading) in enumerate(panels):
        axes = figure.add_axes((0.06 + 0.32 * (place % 2), 0.56 - 0.48 * (place // 2), 0.27, 0.34))
        for row, colour in zip(values, colours):
            axes.plot(found.spin_deg, row, color=colour, marker=".", markersize=3, linewidth=1)
        axes.set_ylim(bottom=0)
        axes.set_xticks(np.arange(-180, 181, 60))
        dress(axes, heading, "spin α / °", label)
    _rings(figure.add_axes((0.71, 0.30, 0.27, 0.42)), found, along, colours)
    return png_bytes(figure)


def _rings(axes: Any, found: Spread, along: Floats, colours: Floats) -> None:
    """Q - P in plan, the feed upwards."""
    across = np.cross(along, [0.0, 0.0, 1.0])
    apart = found.contacts[:, :, 1] - found.contacts[:, :, 0]
    for one, at, colour in zip(apart, found.points, colours):
        label = f"({at[0]:g}, {at[1]:g})"
        axes.plot(one @ across, one @ along, ".", color=colour, markersize=4, label=label)
    axes.plot(0, 0, "k+")
    axes.set_aspect("equal", adjustable="datalim")
    dress(axes, "Second contacts of all spins, P at +", "across the feed / mm", "along the feed / mm")
    axes.legend(
        title="footprint / mm", fontsize=8, frameon=False, loc="upper left", bbox_to_anchor=(0, -0.17), ncol=3
    )


def draw_control(before: Plan, after: Plan, title: str) -> bytes:
    """A PNG: the contact spacing at the positions in plan and along the passes, without control above, with it below."""
    figure = _figure(title)
    wanted = after.job.method.contact_spacing_mm
    rows = [(before, "Spin 0", 0.53), (after, f"Spin for {wanted:g} mm", 0.06)]
    values = [_spacing_of(plan, after) for plan, _, _ in rows]
    top = max(1.2 * wanted, *(float(np.nanmax(one)) for one in values))
    for (plan, name, bottom), spread in zip(rows, values):
        _map(figure, bottom, plan, spread, top, wanted, name)
        axes = figure.add_axes((0.50, bottom + 0.02, 0.47, 0.34))
        _along_passes(axes, plan, spread, wanted)
        axes.set_ylim(0, 1.05 * top)
        dress(axes, f"{name}: the same along the passes", "first contact along the feed / mm", "spacing / mm")
    return png_bytes(figure)


def _spacing_of(plan: Plan, wanted: Plan) -> Floats:
    along = plan.scene.frame.direction_to_part(spacing.feed(plan.job.footprint.direction_deg))
    measure = wanted.job.method.spacing_measure
    return spacing.contact_spacing(plan.contacts, plan.status, measure, along)


def _map(
    figure: Any, bottom: float, plan: Plan, spread: Floats, top: float, wanted: float, name: str
) -> None:
    axes = figure.add_axes((0.05, bottom + 0.02, 0.33, 0.38))
    first = plan.scene.frame.to_setup(plan.contacts[:, 0])
    second = plan.scene.frame.to_setup(plan.contacts[:, 1])
    for p, q, value in zip(first, second, spread):
        if np.isfinite(value):
            colour = colormaps[COLOURS](value / top)
            axes.plot([p[0], q[0]], [p[1], q[1]], color=colour, linewidth=1.0)
    kept = np.abs(spread - wanted) <= spacing.TOLERANCE * wanted
    axes.plot(*first[~kept, :2].T, ".", color=MISSED, markersize=2)
    axes.set_aspect("equal")
    share = f"{np.count_nonzero(kept)} of {len(kept)}"
    dress(axes, f"{name}: {share} within 1 % (others: red)", "x / mm", "y / mm")
    bar = figure.add_axes((0.395, bottom + 0.02, 0.012, 0.38))
    bar.imshow(
        np.linspace(0, top, 64)[:, None], origin="lower", aspect="auto", extent=(0, 1, 0, top), cmap=COLOURS
    )
    bar.set_xticks([])
    bar.set_title("mm", fontsize=8)
    bar.tick_params(labelsize=8)


def _along_passes(axes: Any, plan: Plan, spread: Floats, wanted: float) -> None:
    along = plan.scene.frame.direction_to_part(spacing.feed(plan.job.footprint.direction_deg))
    passes = np.unique(plan.pass_index)
    axes.axhspan(
        wanted * (1 - spacing.TOLERANCE), wanted * (1 + spacing.TOLERANCE), color="#F2C9C9", linewidth=0
    )
    for index, colour in zip(passes, colormaps[COLOURS](np.linspace(0.0, 0.9, max(len(passes), 1)))):
        of_pass = plan.pass_index == index
        axes.plot(plan.contacts[of_pass, 0] @ along, spread[of_pass], color=colour, linewidth=0.9)


def _figure(title: str) -> Figure:
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.97, title, fontsize=14, weight="bold", va="center")
    return figure
