"""How a job's links are laid."""

from __future__ import annotations

from .. import _core
from .job import Job
from .motions import control_deviation_deg, control_tip_deviation_mm
from .verdict import cut_depth_mm

# A cut may join positions that are this many forward steps apart; the pattern itself leaves no wider ones in a pass.
CUT_LENGTH_STEPS = 1.5


def link_options(job: Job, guarantee: str) -> _core.LinkOptions:
    """Heights, distances and limits of the links between cuts. guarantee: of the positions, "sampled" or "proven"."""
    spec = job.link
    return _core.LinkOptions(
        safe_clearance_mm=spec.safe_clearance_mm,
        approach_distance_mm=spec.approach_distance_mm,
        gouge_mm=job.tolerance.gouge_mm,
        cut_length_max_mm=cut_length_max_mm(job),
        depth_mm=cut_depth_mm(job.tolerance, guarantee),
        tip_deviation_mm=control_tip_deviation_mm(job),
        axis_deviation_deg=control_deviation_deg(job),
    )


def cut_length_max_mm(job: Job) -> float:
    """How far apart (mm) neighbours of a pass may be to be joined by a cut; a spun tool also goes round its contact."""
    swing = 2 * job.tool.radius_mm if job.method.contact_spacing_mm else 0.0
    return CUT_LENGTH_STEPS * job.footprint.forward_step_mm + swing
