"""The files that a plan is handed over in."""

from __future__ import annotations

from pathlib import Path

from .. import removal
from ..base import Stages
from ..path import cl_file, to_apt
from ..pictures import plan as picture
from ..planning import Plan
from ..program import find_shop, proof_file
from ..removal import mesh_file
from ..report import text, to_json


def files(plan: Plan, cut: removal.Cut, stages: Stages) -> dict[str, bytes | str]:
    """File name -> content, everything ready to be written together. cut: of the plan's path."""
    return {
        "cl.csv": stages.run("cl.csv", cl_file.to_csv, plan.positions, plan.path),
        "cl.apt": stages.run("cl.apt", _apt, plan),
        plan.program.file_name: plan.program.text,
        "report.json": to_json(plan.report),
        "report.txt": text(plan.report),
        "machined.stl": stages.run("machined.stl", _machined_stl, cut),
        "path.png": stages.run("path.png", _picture, plan),
    }


def proof(plan: Plan) -> dict[str, bytes | str]:
    """The proof program of the plan's machine and post, as a file."""
    made = proof_file(plan.job, find_shop(plan.job), plan.scene.model.bounds())
    return {made.file_name: made.text}


def _apt(plan: Plan) -> str:
    post, tool = plan.job.post, plan.job.tool
    feeds = dict.fromkeys(("cut", "link"), post.cut_feed_mm_per_min)
    feeds |= dict.fromkeys(("plunge", "retract"), post.plunge_feed_mm_per_min)
    return to_apt(plan.path, post.program_name, tool.radius_mm, tool.minor_radius_mm, feeds)


def _machined_stl(cut: removal.Cut) -> bytes:
    mesh = cut.mesh()
    return mesh_file.to_bytes("machined.stl", mesh.vertices, mesh.triangles)


def _picture(plan: Plan) -> bytes:
    scene, job = plan.scene, plan.job
    return picture.render(
        plan,
        [*scene.machined, *scene.check],
        machined=[face.name for face in scene.machined],
        gouge_mm=job.tolerance.gouge_mm,
        title=f"{Path(job.part.file).name}, {job.method.name}: {len(plan)} positions",
    )
