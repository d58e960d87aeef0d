"""Deviations of a machined surface in bands: what counts together, in which colour, how much there is of it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..base import Floats, Integers

Colour = tuple[float, float, float]

# A tolerance of zero has no multiples; then those of a micrometre are used.
LEAST_TOLERANCE_MM = 1e-3
# Bands end at these multiples of the tolerance.
GOUGES, REMAINDERS = (10.0, 1.0), (1.0, 5.0, 20.0, 100.0)
# From deep gouges (red) over what is within the tolerance (green) to much that remains (blues).
COLOURS: tuple[Colour, ...] = (
    (0.50, 0.00, 0.13),
    (0.90, 0.33, 0.10),
    (0.36, 0.68, 0.35),
    (0.78, 0.89, 0.93),
    (0.50, 0.75, 0.87),
    (0.20, 0.52, 0.76),
    (0.10, 0.25, 0.55),
)


@dataclass(frozen=True)
class Bands:
    """`edges` (E,) in mm, ascending: band i holds what is above edge i - 1 up to edge i."""

    edges: Floats

    def of(self, deviation_mm: Floats) -> Integers:
        """The band (N,) of each deviation."""
        return np.searchsorted(self.edges, deviation_mm, side="left")

    @property
    def names(self) -> list[str]:
        """What each band holds, from the deepest gouge on."""
        texts = [length(edge) for edge in self.edges]
        between = [f"{low} to {high}" for low, high in zip(texts, texts[1:])]
        return [f"below {texts[0]}", *between, f"above {texts[-1]}"]

    def shares(self, deviation_mm: Floats) -> list[float]:
        """What part of the points each band holds."""
        counts = np.bincount(self.of(deviation_mm), minlength=len(COLOURS))
        return (counts / max(len(deviation_mm), 1)).tolist()


def bands(tolerance_mm: float) -> Bands:
    """Bands for a path that may cut in by `tolerance_mm`: what deviates by no more, up or down, is one of them."""
    unit = max(tolerance_mm, LEAST_TOLERANCE_MM)
    return Bands(unit * np.array([*(-k for k in GOUGES), *REMAINDERS]))


def length(mm: float) -> str:
    """A signed length as people read it: µm below a tenth of a millimetre."""
    return f"{mm * 1000:+.4g} µm" if abs(mm) < 0.1 else f"{mm:+.4g} mm"


def share(part: float) -> str:
    """A part of the whole in percent; what is there is never given as 0."""
    return f"{100 * part:.1f} %" if part == 0 or part >= 0.0005 else "< 0.1 %"


def table(found: Bands, shares: Sequence[float]) -> list[str]:
    """One line a band that holds something."""
    return [f"{name}: {share(part)}" for name, part in zip(found.names, shares) if part > 0]
