"""The picture's side panels: tilt along the passes, histogram of clearances, key with counts."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.lines import Line2D

from ..base import Floats
from ..planning import Plan
from . import style
from .figure import dress

BINS = 40
SHOWN_PERCENT = 99.0  # of the clearances, from below, set the histogram's range
LEAST_BAR = 0.7  # bottom of the logarithmic scale: a single position still shows


def tilt(axes: Any, plan: Plan) -> None:
    """Tilt over the way along the pass, one line a pass."""
    passes = np.unique(plan.pass_index)
    colours = colormaps["viridis"](np.linspace(0.0, 0.9, max(len(passes), 1)))
    for index, colour in zip(passes, colours):
        of_pass = plan.pass_index == index
        axes.plot(_way(plan.tip[of_pass]), plan.positions.tilt_deg[of_pass], color=colour, linewidth=1.0)
    first_to_last = f", pass {passes[0]} (dark) to {passes[-1]} (light)" if len(passes) > 1 else ""
    dress(axes, f"Tilt along the passes{first_to_last}", "way of the tip along the pass / mm", "tilt / °")


def _way(tips: Floats) -> Floats:
    """Length along the polyline through `tips` (N, 3), positions without a pose bridged."""
    way = np.full(len(tips), np.nan)
    there = np.isfinite(tips).all(axis=1)
    steps = np.linalg.norm(np.diff(tips[there], axis=0), axis=1)
    way[there] = np.concatenate([[0.0], np.cumsum(steps)])[: there.sum()]
    return way


def clearance(axes: Any, plan: Plan, gouge_mm: float) -> None:
    """How many positions have which least clearance; those past the range are in the last bar."""
    least = plan.clearance[style.visited(plan), 1] * 1000.0
    least = least[np.isfinite(least)]
    dress(axes, "Least clearance of the positions", "clearance / µm (below 0: cuts in)", "positions")
    if not len(least):
        axes.text(0.5, 0.5, "no clearance measured", transform=axes.transAxes, ha="center", color="#777777")
        return
    limit = -gouge_mm * 1000.0
    low, high = min(least.min(), 2 * limit), max(np.percentile(least, SHOWN_PERCENT), -limit)
    _, edges, bars = axes.hist(
        np.minimum(least, high), bins=np.linspace(low, high, BINS + 1), color="#0072B2"
    )
    for edge, bar in zip(edges, bars):
        if edge < limit:
            bar.set_facecolor(style.GOUGE)
    axes.set_yscale("log")
    axes.set_ylim(bottom=LEAST_BAR)
    axes.axvline(limit, color=style.GOUGE, linewidth=1.0, linestyle="--")


def key(axes: Any, plan: Plan, gouge_mm: float) -> None:
    """What the colours mean and how many there are of each."""
    axes.axis("off")
    left = axes.legend(
        handles=_status_handles(plan, gouge_mm), loc="upper left", title="Positions", **_LEGEND
    )
    axes.add_artist(left)
    axes.legend(handles=_move_handles(plan), loc="upper right", title="Moves", **_LEGEND)


_LEGEND = {"frameon": False, "fontsize": 9, "title_fontsize": 10, "alignment": "left", "borderaxespad": 0.0}


def _status_handles(plan: Plan, gouge_mm: float) -> list[Line2D]:
    counts = Counter(plan.status.tolist()).most_common()
    handles = [
        Line2D(
            [],
            [],
            color=style.status_colour(status),
            linewidth=3,
            label=f"{count}  {status.replace('_', ' ')}",
        )
        for status, count in counts
    ]
    contacts = np.isfinite(plan.contacts).all(axis=2).sum(axis=0)
    handles.append(_dot(style.FIRST_CONTACT, f"{contacts[0]}  first contact P"))
    handles.append(_dot(style.SECOND_CONTACT, f"{contacts[1]}  second contact Q"))
    deep = int(np.count_nonzero(style.gouging(plan.positions, gouge_mm)))
    handles.append(_ring(style.GOUGE, f"{deep}  deeper than {gouge_mm * 1000:g} µm"))
    return handles


def _dot(colour: str, label: str) -> Line2D:
    return Line2D(
        [], [], linestyle="", marker="o", markersize=5, color=colour, markeredgecolor="#555555", label=label
    )


def _ring(colour: str, label: str) -> Line2D:
    return Line2D(
        [], [], linestyle="", marker="o", markersize=6, markerfacecolor="none", color=colour, label=label
    )


def _move_handles(plan: Plan) -> list[Line2D]:
    counts = Counter(plan.path.kind.tolist())
    handles = [
        Line2D([], [], color=style.STATUS_COLOURS["two_contacts"], label=f"{counts['cut']}  cut, by status")
    ]
    for kind, (colour, dashes) in style.LINK_STYLES.items():
        if counts[kind]:
            handles.append(
                Line2D([], [], color=colour, linestyle=dashes, linewidth=1, label=f"{counts[kind]}  {kind}")
            )
    blocked = int(np.count_nonzero(plan.path.blocked))
    if blocked:
        handles.append(Line2D([], [], color=style.GOUGE, linewidth=2, label=f"{blocked}  blocked"))
    handles.append(Line2D([], [], color=style.AXIS, linewidth=0.8, label="tool axes"))
    return handles
