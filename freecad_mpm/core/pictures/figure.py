"""What all pictures share: how a diagram's frame looks, and a figure as a file."""

from __future__ import annotations

import io
from typing import Any

from matplotlib.figure import Figure


def dress(axes: Any, title: str, x: str, y: str) -> None:
    """Title, axis labels (with units), a quiet grid, and no frame above or to the right."""
    axes.set_title(title, fontsize=10, loc="left")
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.tick_params(labelsize=8)
    axes.grid(color="#E6E6E6", linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def png_bytes(figure: Figure) -> bytes:
    """The figure as PNG, at its own dpi."""
    png = io.BytesIO()
    figure.savefig(png, format="png", dpi=figure.dpi)
    return png.getvalue()
