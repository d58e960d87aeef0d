"""How much memory a cut takes, said before it starts, and refused when the machine has not so much."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np

from ... import _core
from ..part import Scene, surface_model
from .cutting import stock_box
from .sweep import Box

Corners = tuple[Sequence[float], Sequence[float]]

# Of the machine's memory that a cut may take.
SHARE = 0.7
GIGABYTE = 1e9
# Measured (docs/removal.md): a point of a face with its ray and triangles; a stock and its mesh beside its dexels alone.
BYTES_A_POINT = 250
MESH_TO_DEXELS = 24
# The faces' area is that of triangles, so many along the stock.
LOOKS = 100
# The resolution that would fit is found to this factor.
FITTING_STEP = 1.05


def needed(scene: Scene, resolution_mm: float, box: Corners | None = None, with_stock: bool = True) -> int:
    """About how many bytes `cutting.cut` will take. Raises ValueError for a resolution or box that is out of range."""
    stock = stock_box(scene, box, resolution_mm)
    points = _area(scene, stock) / resolution_mm**2
    dexels = _core.DexelStock.bytes_needed(stock.lo, stock.hi, resolution_mm) if with_stock else 0
    return int(BYTES_A_POINT * points + MESH_TO_DEXELS * dexels)


def available() -> float:
    """Bytes that a cut may take; infinite where the system does not say what it has."""
    try:
        return SHARE * os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):  # not a POSIX system
        return float("inf")


def check(scene: Scene, resolution_mm: float, box: Corners | None = None, with_stock: bool = True) -> str:
    """One line that says what the cut takes. Raises ValueError, naming a resolution that would fit, when that is more
    than the machine may give."""
    stock_box(scene, box, resolution_mm)
    there_is = available()

    def problem(resolution: float) -> str:
        try:
            takes = needed(scene, resolution, box, with_stock)
        except ValueError as error:  # more dexels than there are numbers for
            return str(error)
        return f"takes {_text(takes)}, and at most {_text(there_is)} may be used" if takes > there_is else ""

    if told := problem(resolution_mm):
        fits = resolution_mm
        while problem(fits):
            fits *= FITTING_STEP
        raise ValueError(f"{resolution_mm:g} mm {told}; {_rounded_up(fits):g} mm would fit, or a small box")
    of = f" of {_text(there_is)}" if np.isfinite(there_is) else ""
    takes = _text(needed(scene, resolution_mm, box, with_stock))
    return f"A cut at {resolution_mm:g} mm takes about {takes}{of} of memory"


def _rounded_up(length_mm: float) -> float:
    """To two digits."""
    digit = 10.0 ** (np.floor(np.log10(length_mm)) - 1)
    return float(np.ceil(length_mm / digit) * digit)


def _text(size: float) -> str:
    return f"{size / GIGABYTE:.1f} GB" if size >= GIGABYTE else f"{size / GIGABYTE * 1000:.0f} MB"


def _area(scene: Scene, stock: Box) -> float:
    """About the area (mm^2) in a box (set-up frame) of all faces, as if none were trimmed short."""
    model = surface_model([*scene.machined, *scene.check], [], scene.frame)
    spacing = float((stock.hi - stock.lo).max()) / LOOKS
    found = _core.sample_surfaces(
        model, spacing_mm=spacing, lo=stock.lo, hi=stock.hi, context=_core.Context()
    )
    corners = found["points"][found["triangles"]]
    inside = ((corners >= stock.lo) & (corners <= stock.hi)).all(axis=2).any(axis=1)
    a, b, c = corners[inside].transpose(1, 0, 2)
    return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
