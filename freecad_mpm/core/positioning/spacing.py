"""How far apart the two contacts of the positions are, and how well a wanted spacing was kept (docs/strip.md)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..base import Flags, Floats, Names
from ..job import ACROSS, MethodSpec
from .positions import Positions

# As the core's kSpacingTolerance: a miss within this part of the wanted spacing is none.
TOLERANCE = 0.01
# In words, by the measure's name.
MEASURES = {ACROSS: "across the feed", "direct": "from contact to contact"}


@dataclass(frozen=True)
class Nearest:
    """What of all spins comes nearest to the wanted spacing, at M points of the footprint."""

    points: Floats = field(default_factory=lambda: np.empty((0, 2)))  # (M, 2) mm, set-up frame
    spacing_mm: Floats = field(default_factory=lambda: np.empty(0))  # (M,); NaN: no spin gives any

    def reached(self, wanted_mm: float) -> Flags:
        """(M,): some spin gives the wanted spacing."""
        return np.asarray(np.abs(self.spacing_mm - wanted_mm) <= TOLERANCE * wanted_mm)


def feed(direction_deg: float) -> Floats:
    """(3,): unit direction of the passes in the set-up frame."""
    angle = np.radians(direction_deg)
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def contact_spacing(contacts: Floats, status: Names, measure: str, along: Floats) -> Floats:
    """(...): mm between the contacts (..., 2, 3), seen along the unit vector `along` or directly, all in one frame;
    0 where they coincide, NaN where there is no second one."""
    apart = contacts[..., 1, :] - contacts[..., 0, :]
    if measure == ACROSS:
        apart = apart - (apart @ along)[..., None] * along
    spacing: Floats = np.linalg.norm(apart, axis=-1)
    return np.where(status == "curvature_matched", 0.0, spacing)


@dataclass(frozen=True)
class KeptSpacing:
    """How well a wanted spacing was kept."""

    wanted_mm: float
    measure: str
    tolerance_mm: float
    kept: int
    of: int
    kept_of_footprint: int
    footprint: int
    unreachable: list[
        dict[str, float | None]
    ]  # x_mm, y_mm (set-up frame), nearest_mm (None: no spin gives any)

    @property
    def sentence(self) -> str:
        """The report's line."""
        text = (
            f"Contacts {self.wanted_mm:g} mm apart {MEASURES[self.measure]}: within {TOLERANCE:.0%} at "
            f"{self.kept_of_footprint} of {self.footprint} positions of the footprint"
        )
        there = [one["nearest_mm"] for one in self.unreachable if one["nearest_mm"] is not None]
        without = len(self.unreachable) - len(there)
        if there:
            text += (
                f"; at {len(there)} no spin gives it, the nearest is {min(there):.2f} to {max(there):.2f} mm"
            )
        return text + (f"; at {without} no spin gives two contacts" if without else "")


def kept_spacing(method: MethodSpec, positions: Positions, nearest: Nearest, along: Floats) -> KeptSpacing:
    """Figures for the report; positions and `along` in one frame."""
    wanted = method.contact_spacing_mm
    spacing = contact_spacing(positions.contacts, positions.status, method.spacing_measure, along)
    kept = np.abs(spacing - wanted) <= TOLERANCE * wanted
    missed = ~nearest.reached(wanted)
    return KeptSpacing(
        wanted_mm=wanted,
        measure=method.spacing_measure,
        tolerance_mm=TOLERANCE * wanted,
        kept=int(np.count_nonzero(kept)),
        of=len(positions),
        kept_of_footprint=int(np.count_nonzero(kept & ~positions.inserted)),
        footprint=int(np.count_nonzero(~positions.inserted)),
        unreachable=[
            {"x_mm": float(x), "y_mm": float(y), "nearest_mm": float(value) if np.isfinite(value) else None}
            for (x, y), value in zip(nearest.points[missed], nearest.spacing_mm[missed])
        ],
    )
