"""Colours and line styles that the parts of the picture share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..planning import Plan
from ..positioning import Positions

# Colours that readers with colour-blindness tell apart (Okabe and Ito, 2008), one a status.
STATUS_COLOURS = {
    "two_contacts": "#0072B2",
    "curvature_matched": "#009E73",
    "tilt_limited": "#56B4E9",
    "one_contact": "#CC79A7",
    "edge_contact": "#8C6D1F",
    "bridged": "#E69F00",
    "off_part": "#999999",
    "undecided": "#000000",
}
OTHER_STATUS = "#999999"
GOUGE = "#D01C1C"
FIRST_CONTACT, SECOND_CONTACT = "#1FA187", "#F5921B"
AXIS = "#3B3B3B"
FACE, CHECK_FACE = (0.80, 0.83, 0.88), (0.95, 0.94, 0.90)

# Everything that is no cut: kind -> colour and line style.
LINK_STYLES = {
    "rapid": ("#7A7A7A", (0, (6, 4))),
    "retract": ("#7A7A7A", (0, (1, 2))),
    "plunge": ("#B5651D", (0, (1, 1))),
    "link": ("#B5651D", "solid"),
}


def status_colour(status: str) -> str:
    """ "#rrggbb"; grey for a status that has none of its own."""
    return STATUS_COLOURS.get(status, OTHER_STATUS)


def visited(plan: Plan) -> NDArray[np.int64]:
    """The positions that the path goes through, each once."""
    positions: NDArray[np.int64] = np.unique(plan.path.position[plan.path.position >= 0])
    return positions


def gouging(positions: Positions, gouge_mm: float) -> NDArray[np.bool_]:
    """(N,): cuts deeper than `gouge_mm`, as far as anybody measured."""
    least = positions.clearance[:, 1]
    deep: NDArray[np.bool_] = np.isfinite(least) & (least < -gouge_mm)
    return deep
