"""Where the tool stands: the footprint, the method, the positions with contacts, statuses and bounds.

Native: `footprint`, `positioning`; each step is one native call.
To add a method: its row in native/src/mpm/positioning; it must pass `tests/contract`."""

from __future__ import annotations

from . import spacing, spins
from .footprint import Footprint, lay_out
from .methods import check_method, guarantee_of, method_names
from .placing import as_positions, make_positioner, place, sample
from .positions import Positions, positions_in_part
from .spins import Spread

__all__ = [
    "Footprint",
    "Positions",
    "Spread",
    "as_positions",
    "check_method",
    "guarantee_of",
    "lay_out",
    "make_positioner",
    "method_names",
    "place",
    "positions_in_part",
    "sample",
    "spacing",
    "spins",
]
