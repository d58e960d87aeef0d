"""PNGs of a plan, a moment, a deviation, a section, spins. All of matplotlib is here and in `bench`.

Each module draws one kind and gives bytes.
To add a picture: a module that ends in `figure.png_bytes`."""

from __future__ import annotations

from . import deviation, plan, playback, section, spins
from .figure import png_bytes

__all__ = ["deviation", "plan", "playback", "png_bytes", "section", "spins"]
