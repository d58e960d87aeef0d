"""What the posts for HEIDENHAIN TNC controls share."""

from __future__ import annotations

from ..base import Floats, InputError
from .options import COMMON
from .program import Program
from .writing import Style, rotary_names, rounded

OPTIONS = COMMON | {"blank", "retract", "path_tolerance_mm", "rotary_tolerance_deg", "smoothing"}
MAX_DECIMALS = 4  # the finest step of the control: 0.1 µm, 0.0001 degrees
LENGTH = "%+.9g"
VECTOR = "%+.7f"
# The control's picture takes no blank with sides over this ratio; such a blank is left out, it only serves the picture.
MAX_BLANK_RATIO = 200.0


def style(program: Program, rapid: str, feed: str, rapid_end: str = "", vectors: bool = False) -> Style:
    """Signed numbers, no more digits than they need; without TCP the feed is that of all words together."""
    if program.options.decimals > MAX_DECIMALS:
        raise InputError(
            f"[post.options] decimals: must be {MAX_DECIMALS} or less, the control takes no more"
        )
    return Style(
        rapid=rapid,
        feed=feed,
        length=LENGTH,
        turn_names=("TX", "TY", "TZ") if vectors else rotary_names(program),
        turn=VECTOR if vectors else LENGTH,
        rapid_end=rapid_end,
        vectors=vectors,
        whole=vectors,
        per_block=not program.tcp,
    )


def blank(program: Program) -> tuple[Floats, Floats] | None:
    """Corners of the blank, rounded, when it is wanted and the control can draw it."""
    if program.blank is None or not program.options.blank:
        return None
    low, high = (rounded(corner, program.options.decimals) for corner in program.blank)
    sides = high - low
    return None if sides.min() <= 0 or sides.max() >= MAX_BLANK_RATIO * sides.min() else (low, high)
