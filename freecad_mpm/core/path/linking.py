"""How a job's links are laid."""

from __future__ import annotations

from collections import Counter

from ... import _core
from ..base import Floats, Stages
from ..job import Job, MethodSpec, control_deviation_deg, control_tip_deviation_mm, cut_depth_mm
from ..part import Scene
from ..positioning import Positions, guarantee_of
from .tool_path import ToolPath, from_core

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


def link(job: Job, scene: Scene, positions: Positions, cuts: Floats | None, stages: Stages) -> ToolPath:
    """The path over the usable positions, in the set-up frame. cuts: (N,) proven clearances of the cuts that end in the
    positions, NaN where there must be none; None: sampling decides."""
    with job.blamed(job.link.table):
        linked = stages.run_native(
            "path",
            _core.link_passes,
            scene.cells,
            scene.tool,
            positions.tip,
            positions.axis,
            positions.pass_index,
            positions.usable,
            options=link_options(job, guarantee_of(job)),
            cut_clearance=cuts,
        )
    if len(linked["kind"]) == 0:
        statuses = Counter(positions.status[~positions.usable].tolist()).most_common()
        told = ", ".join(f"{count} {status}" for status, count in statuses)
        raise job.error(
            MethodSpec.table,
            "name",
            f"{job.method.name} found no usable position for this tool and part: {told}",
        )
    return from_core(linked)
