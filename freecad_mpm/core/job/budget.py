"""The tolerance budget: who may use how much of the two tolerances."""

from __future__ import annotations

import numpy as np

from .tables import Job, Tolerance

# What of the chord tolerance the control may use for its own way from axis to axis. At moves of a degree it needs a
# hundredth; each further quarter would be missing for the chord itself.
CONTROL_SHARE = 0.25


def control_deviation_deg(job: Job) -> float:
    """How far (degrees) the machine's real axis may be off the great circle between two given axes."""
    return axis_tolerance_deg(CONTROL_SHARE * job.tolerance.chord_mm, job.tool.radius_mm)


def control_tip_deviation_mm(job: Job) -> float:
    """How far the tip may be off its line between two blocks: not at all where the control holds it."""
    return 0.0 if job.post.tcp else CONTROL_SHARE * job.tolerance.chord_mm


def axis_tolerance_deg(chord_mm: float, radius_mm: float) -> float:
    """The error of the tool's direction that moves the rim of a cutter by no more than the chord tolerance."""
    return float(np.degrees(chord_mm / radius_mm))


# What rounding to the words' decimals may add to the allowances between two blocks.
WORD_SLACK = 1.05

PROVEN = "proven"


def cut_depth_mm(tolerance: Tolerance, guarantee: str) -> float:
    """What a cut may cut in between its positions. Proven: the chord tolerance, but not less than its ends may;
    sampled: gouge and chord tolerance together, for the chord of a move starts from the depth of its ends."""
    if guarantee == PROVEN:
        return max(tolerance.chord_mm, tolerance.gouge_mm)
    return tolerance.gouge_mm + tolerance.chord_mm
