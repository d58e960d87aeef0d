"""The deviation map as a picture: the faces from above in the colours of their bands, a histogram, the worst places."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from ..base import Floats, Integers
from ..removal import Bands, Cut, Extreme
from ..removal import bands as deviation_bands
from .figure import dress, png_bytes

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
RIGHT = 0.70  # where what stands beside the map begins
CELLS = 800  # along the longer side of the map
BINS = 80
# The histogram ends at this percentile: a few points beside the path would leave no room for the others.
SHOWN_PERCENT = 99.5
# The worst places: marker, colour, name.
MARKS = (
    ("v", "#7A0019", "Worst gouge"),
    ("^", "#0B2A63", "Largest remainder"),
    ("s", "#000000", "Deepest in a check face"),
)


@dataclass(frozen=True, eq=False)
class Map:
    """What is drawn; set-up frame, seen from +z, mm."""

    points: Floats  # (N, 3); the first `measured` on the faces to machine, the others on check faces
    triangles: Integers  # (T, 3) of points
    deviation_mm: Floats  # (N,), > 0 remains, < 0 is cut in
    measured: int
    worst: Sequence[Extreme | None]  # as MARKS has them
    resolution_mm: float


def map_of(cut: Cut) -> Map:
    """The faces to machine, and the check faces where they are cut."""
    found, aside, frame = cut.deviation, cut.overcut, cut.scene.frame
    return Map(
        frame.to_setup(np.concatenate((found.points, aside.points))),
        np.concatenate((found.triangles, aside.triangles + len(found.points))),
        np.concatenate((found.deviation_mm, -aside.depth_mm)),
        len(found.points),
        [one and one._replace(point=frame.to_setup(one.point)) for one in cut.worst()],
        cut.resolution_mm,
    )


def render(shown: Map, bands: Bands, title: str) -> bytes:
    """A PNG of 1600 x 1000 pixels. A spot has the colour of its worst corner: a gouge anywhere before what remains."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.965, title, fontsize=14, weight="bold", va="center")
    axes = figure.add_axes((0.06, 0.07, 0.60, 0.85))
    _fill(axes, shown, bands)
    _mark(axes, shown.worst)
    of_faces = shown.deviation_mm[: shown.measured]
    _key(figure, bands, bands.shares(of_faces))
    _histogram(figure.add_axes((RIGHT + 0.035, 0.36, 0.25, 0.22)), of_faces, bands)
    _worst_lines(figure, shown.worst)
    figure.text(RIGHT, 0.07, f"{shown.measured} points, every {shown.resolution_mm:g} mm", fontsize=10)
    return png_bytes(figure)


def _fill(axes: Any, shown: Map, bands: Bands) -> None:
    """As an image: a drawn triangle takes a hundred times the memory of a measured one."""
    corners = shown.points[shown.triangles, :2].astype(np.float64)  # (T, 3, 2)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    cell = float((high - low).max()) / CELLS
    last = np.floor((high - low) / cell).astype(int)  # column and row
    image = np.ones((last[1] + 1, last[0] + 1, 3))
    band = bands.of(shown.deviation_mm)[shown.triangles].min(axis=1)
    for worse in range(len(deviation_bands.COLOURS) - 1, -1, -1):  # the worst last: it stays
        for places in _spread(corners[band == worse], cell):
            # Rounding may lead out of the image by a hair.
            column, row = np.clip(np.floor((places - low) / cell), 0, last).astype(int).T
            image[row, column] = deviation_bands.COLOURS[worse]
    extent = (low[0], low[0] + cell * image.shape[1], low[1], low[1] + cell * image.shape[0])
    axes.imshow(image, origin="lower", extent=extent, interpolation="nearest", zorder=1)
    axes.margins(0.05)
    dress(axes, "", "set-up x / mm", "set-up y / mm")


def _spread(corners: Floats, cell: float) -> Iterator[Floats]:
    """Points (T, 2) of all triangles (T, 3, 2), less than a cell apart."""
    if not len(corners):
        return
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max()
    steps = max(1, int(np.ceil(longest / cell)))
    for i in range(steps + 1):
        for j in range(steps + 1 - i):
            yield np.tensordot(corners, np.array([i, j, steps - i - j]) / steps, axes=(1, 0))


def _mark(axes: Any, worst: Sequence[Extreme | None]) -> None:
    for (marker, colour, _), one in zip(MARKS, worst):
        if one is not None:
            looks = {"marker": marker, "markersize": 11, "color": colour, "markeredgecolor": "white"}
            axes.plot(*one.point[:2], linestyle="", **looks)


def _key(figure: Any, bands: Bands, shares: list[float]) -> None:
    rows = zip(bands.names, deviation_bands.COLOURS, shares)
    handles = [
        Patch(color=colour, label=f"{name}: {deviation_bands.share(part)}") for name, colour, part in rows
    ]
    figure.legend(
        handles=handles,
        loc="upper left",
        bbox_to_anchor=(RIGHT - 0.005, 0.93),
        title="Deviation along the normal\n(+ remains, − is cut in)",
        alignment="left",
        frameon=False,
        fontsize=11,
    )


def _histogram(axes: Any, deviation_mm: Floats, bands: Bands) -> None:
    low, high = float(deviation_mm.min()), float(np.percentile(deviation_mm, SHOWN_PERCENT))
    _, edges, bars = axes.hist(
        np.minimum(deviation_mm, high),
        bins=np.linspace(low, max(high, low + bands.edges[-1] / BINS), BINS + 1),
    )
    for band, bar in zip(bands.of((edges[1:] + edges[:-1]) / 2), bars):
        bar.set_facecolor(deviation_bands.COLOURS[band])
    axes.set_yscale("log")
    dress(axes, "How many points deviate how much", "deviation / mm", "points")


def _worst_lines(figure: Any, worst: Sequence[Extreme | None]) -> None:
    there_are = [(mark, one) for mark, one in zip(MARKS, worst) if one is not None]
    for row, ((marker, colour, name), one) in enumerate(there_are):
        y = 0.26 - 0.065 * row
        line = figure.add_axes((RIGHT, y, 0.012, 0.02))
        line.axis("off")
        line.plot([0], [0], marker=marker, color=colour, markersize=9)
        words = f"{name}: {deviation_bands.length(one.deviation_mm)}"
        figure.text(RIGHT + 0.018, y + 0.01, words, color=colour, fontsize=11, weight="bold", va="center")
        figure.text(RIGHT + 0.018, y - 0.012, _place(one), fontsize=10, va="center")


def _place(one: Extreme) -> str:
    x, y, z = one.point
    after = f"after move {one.move}" if one.move >= 0 else "no move cut there"
    return f"set-up {x:.2f} {y:.2f} {z:.2f}, {after}"
