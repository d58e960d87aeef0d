"""The files that a plan is handed over in."""

from __future__ import annotations

from . import cl_file, report
from .apt import to_apt
from .plan import Plan
from .stages import Stages


def files(plan: Plan, stages: Stages) -> dict[str, bytes | str]:
    """File name -> content, everything ready to be written together."""
    job = plan.job
    feeds = dict.fromkeys(("cut", "link"), job.post.cut_feed_mm_per_min)
    feeds |= dict.fromkeys(("plunge", "retract"), job.post.plunge_feed_mm_per_min)
    return {
        "cl.csv": stages.run("cl.csv", cl_file.to_csv, plan, plan.path),
        "cl.apt": to_apt(
            plan.path, job.post.program_name, job.tool.radius_mm, job.tool.minor_radius_mm, feeds
        ),
        plan.program.file_name: plan.program.text,
        "report.json": report.to_json(plan.report),
        "report.txt": report.text(plan.report),
    }
