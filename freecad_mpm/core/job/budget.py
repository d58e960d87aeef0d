"""The tolerance budget: who may use how much of the two tolerances.

    [tolerance] gouge_mm   what a position may cut in: the method's certificate, and nobody else
    [tolerance] chord_mm   what a cut may cut in between its positions (not less than gouge_mm), where it is proven:

        |<------------------------- cut_depth_mm ------------------------->|
        |  certified_depth_mm: by the motion's certificate    |  tip share |   tip share: only where the control does
        |  chord of the true path  |  axis share * lever      |            |   not hold the tip

    Each share of the control is CONTROL_SHARE of the chord: at the cutter's rim for the axis, at the tip for the tip.
    The certificate takes the axis' share off again at the full length of its lever. Reading a program back, the words'
    rounding may add WORD_SLACK to both. Sampled cuts may use both tolerances: their chord starts from their ends' depth.
    Rapids may cut in nothing at all."""

from __future__ import annotations

import numpy as np

from ..base import Floats
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


def certified_depth_mm(job: Job, depth_mm: Floats | float) -> Floats | float:
    """How deep a certificate may find a move that may cut in by depth_mm: a tip that is off its line takes as much."""
    return depth_mm - control_tip_deviation_mm(job)


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
