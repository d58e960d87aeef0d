"""Cuts between positions: certificates, positions put in between, and what is said of them."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core import job, planning
from freecad_mpm.core.base import EXAMPLES, TOOLS, Cancelled, Stages
from freecad_mpm.core.job import FootprintSpec, Job, Part, control_deviation_deg, tool
from freecad_mpm.core.job.budget import CONTROL_SHARE
from freecad_mpm.core.path import cl_file, judge
from freecad_mpm.core.planning import Plan
from freecad_mpm.core.report.statement import statement
from freecad_mpm.core.report.text import text
from freecad_mpm.core.report.warnings import unproven

# A cancel must stop the work within 0.1 s. What the threads work from then on is counted, which other programs on the
# machine do not lengthen; the rest is for slower processors.
CANCEL_S, SLACK_S, THREADS = 0.1, 0.4, 2


@pytest.fixture
def thesis_job(thesis_part: Callable[[str], Path]) -> Job:
    """Steps so long that the chord tolerance asks for positions in between."""
    return Job(
        part=Part(file=str(thesis_part("saddle"))),
        tool=tool.load(TOOLS / "thesis.toml"),
        footprint=FootprintSpec(side_step_mm=75, forward_step_mm=6),
    )


@pytest.fixture
def plan(thesis_job: Job) -> Plan:
    return planning.plan(thesis_job)


def test_every_cut_of_a_proven_plan_is_proven(plan: Plan) -> None:
    cuts = plan.path.kind == "cut"
    assert (plan.path.clearance[cuts] >= -plan.job.tolerance.chord_mm).all()
    assert plan.report.positions.inserted == np.count_nonzero(plan.inserted) > 0
    assert np.count_nonzero(cuts) == np.count_nonzero(plan.neighbours) - plan.report.path.moves_not_cut
    assert (np.diff(plan.pass_index) >= 0).all()
    # Passes run along y: what was put in stands in its place.
    for number in np.unique(plan.pass_index):
        assert (np.diff(plan.tip[plan.pass_index == number, 1]) > 0).all()


@pytest.mark.parametrize(
    ("kinds", "parts", "depth", "found"),
    [
        (["cut"], 4, 0.01, -1e-9),
        (["plunge", "retract"], 20, 0.01, 0.2),
        (["rapid"], 10, 0.0, np.inf),
    ],
)
def test_moves_are_clear_at_poses_that_nobody_certified(
    plan: Plan, kinds: list[str], parts: int, depth: float, found: float
) -> None:
    """Samples along the moves, by the judge that knows nothing of the certificate."""
    ends = np.flatnonzero(np.isin(plan.path.kind, kinds))
    ends = ends[ends > 0]
    least = np.inf
    for part in np.arange(1, parts) / parts:
        tip = (1 - part) * plan.path.tip[ends - 1] + part * plan.path.tip[ends]
        axis = (1 - part) * plan.path.axis[ends - 1] + part * plan.path.axis[ends]
        axis /= np.linalg.norm(axis, axis=1)[:, None]  # small turns: near enough to the great circle
        sampled = _core.sampled_clearance(plan.scene.model, plan.scene.tool, tip, axis, _core.Context())
        least = min(least, float(sampled.min()))
    assert -depth <= least <= found


def test_the_report_ends_with_one_statement(plan: Plan) -> None:
    usable, cuts = np.count_nonzero(plan.usable), np.count_nonzero(plan.path.kind == "cut")
    slow = np.count_nonzero(np.isin(plan.path.kind, ("plunge", "retract")))
    rapids = np.count_nonzero(plan.path.kind[1:] == "rapid")
    said = (
        f"free to 1 µm at all {usable} positions, within 10 µm on all {cuts} cuts between them, "
        f"within 10 µm on all {slow} plunges and retracts, clear on all {rapids} rapids, proven"
    )
    assert plan.report.statement == said
    assert text(plan.report).splitlines()[-1].startswith(said[1:], 1)


def test_links_that_are_not_proven_are_named(plan: Plan) -> None:
    links = np.flatnonzero(plan.path.kind != "cut")[1:]
    retract = links[plan.path.kind[links] == "retract"][0]
    rapid, plunge = retract + 1, retract + 1 + plan.path.kind[retract + 1 :].tolist().index("plunge")
    proven = np.ones(len(plan.path), dtype=bool)
    proven[[retract, rapid, plunge]] = False
    path = replace(plan.path, proven=proven)
    (line,) = unproven(path)
    left, reached = path.position[retract - 1], path.position[plunge]
    assert line.startswith(f"3 links are not proven free: retract from position {left} (least clearance")
    assert f"rapid to position {reached} (" in line and f"plunge to position {reached} (" in line
    said = statement(plan, path, plan.job.tolerance, "proven")
    slow = np.count_nonzero(np.isin(path.kind, ("plunge", "retract")))
    rapids = np.count_nonzero(path.kind[1:] == "rapid")
    assert f"on {slow - 2} of {slow} plunges and retracts, clear on {rapids - 1} of {rapids} rapids" in said
    assert unproven(plan.path) == []


def test_the_machine_gets_the_deviation_that_the_certificate_took_off(plan: Plan) -> None:
    spec = plan.job
    share_mm = CONTROL_SHARE * spec.tolerance.chord_mm
    assert control_deviation_deg(spec) == pytest.approx(np.degrees(share_mm / spec.tool.radius_mm))
    assert plan.report.program.report.findings == []


def test_a_sampled_method_gets_no_positions_and_no_proof(thesis_job: Job) -> None:
    plan = planning.plan(replace(thesis_job, method=job.MethodSpec("vcrf")))
    assert not plan.inserted.any()
    assert "no proof" in plan.report.statement


def test_verify_judges_the_cuts_of_a_file(plan: Plan, tmp_path: Path) -> None:
    text = cl_file.to_csv(plan.positions, plan.path)
    (tmp_path / "cl.csv").write_text(text)
    good = judge.verify(plan.job, cl_file.read_csv(tmp_path / "cl.csv"), Stages())
    assert good.good and len(good.verdict) == len(good.moves) - 1
    lines = text.splitlines()
    # Without the positions between, the tool takes the chord.
    inserted = set(np.flatnonzero(plan.inserted).tolist())
    rows = [i for i, line in enumerate(lines) if ",cut," in line]
    thin = [line for i, line in enumerate(lines) if i not in rows or rows.index(i) not in inserted]
    (tmp_path / "thin.csv").write_text("\n".join([*thin, ""]))
    bad = judge.verify(plan.job, cl_file.read_csv(tmp_path / "thin.csv"), Stages())
    assert not bad.good and (bad.clearance >= -plan.job.tolerance.gouge_mm).all()
    assert any("First bad one: on line" in line for line in bad.lines)


def test_a_cancel_stops_the_certificates_soon(thesis_job: Job) -> None:
    fine = replace(thesis_job, footprint=FootprintSpec(side_step_mm=10, forward_step_mm=1))
    cancel = threading.Event()
    stopped = []

    def on_progress(now: str, fraction: float) -> None:
        if now == "motions" and 0.0 < fraction < 1.0 and not cancel.is_set():
            cancel.set()
            stopped.append(time.process_time())

    with pytest.raises(Cancelled):
        planning.plan(fine, on_progress=on_progress, cancel=cancel, threads=THREADS)
    assert time.process_time() - stopped[0] < THREADS * CANCEL_S + SLACK_S


@pytest.mark.parametrize("name", ["convex", "concave", "saddle", "bonnet_die"])
def test_all_moves_of_a_shipped_example_are_proven(name: str) -> None:
    plan = planning.plan(job.load(EXAMPLES / f"{name}.toml"))
    assert plan.report.path.moves_not_cut == 0
    assert plan.report.path.worst_cut_clearance_mm >= -0.01
    assert plan.path.proven.all() and plan.report.path.links_not_proven == []
    assert "rapids, proven" in plan.report.statement and " of " not in plan.report.statement
