"""The façade: the thesis' footprint, independence of threads and frames, faces, progress and cancel."""

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
from freecad_mpm.core.base import TOOLS, Cancelled, InputError, Stages
from freecad_mpm.core.job import FootprintSpec, Job, MethodSpec, Part, Setup, Tolerance
from freecad_mpm.core.job import tool as tools
from freecad_mpm.core.part import prepare
from freecad_mpm.core.part.file import read_part
from freecad_mpm.core.part.frame import frame_of
from freecad_mpm.core.part.scene import native_tool
from freecad_mpm.core.path import cl_file
from freecad_mpm.core.planning import Plan
from freecad_mpm.core.positioning import lay_out, method_names
from freecad_mpm.core.positioning.footprint import unbroken_runs
from freecad_mpm.core.positioning.methods import method_options

# A cancel must stop the work within 0.1 s. What the threads work from then on is counted, which other programs on the
# machine do not lengthen; the rest is for slower processors.
CANCEL_S, SLACK_S, THREADS = 0.1, 0.4, 2


@pytest.fixture
def thesis_job(thesis_part: Callable[[str], Path]) -> Job:
    return Job(
        part=Part(file=str(thesis_part("saddle"))),
        tool=tools.load(TOOLS / "thesis.toml"),
        method=MethodSpec("vcrf"),
        tolerance=Tolerance(gouge_mm=0.02, chord_mm=2.0),
    )


@pytest.fixture
def coarse_job(thesis_job: Job) -> Job:
    return replace(thesis_job, footprint=FootprintSpec(side_step_mm=50, forward_step_mm=25))


def test_the_thesis_footprint_comes_out_exactly(thesis_job: Job) -> None:
    stages = Stages()
    job = replace(thesis_job, footprint=FootprintSpec(side_step_mm=18.0))
    footprint = lay_out(job, prepare(job, None, stages), stages)
    x, y = np.meshgrid([*range(0, 145, 18), 150], np.arange(0, 151, 2), indexing="ij")
    assert footprint.points.tolist() == np.dstack((x, y)).reshape(-1, 2).astype(float).tolist()
    assert footprint.pass_index.tolist() == np.repeat(np.arange(10), 76).tolist()


def test_a_plan_holds_what_it_says(coarse_job: Job) -> None:
    plan = planning.plan(coarse_job)
    count = 4 * 7
    shapes = {
        "tip": (3,),
        "axis": (3,),
        "contacts": (2, 3),
        "normals": (2, 3),
        "clearance": (2,),
        "status": (),
    }
    for name, shape in shapes.items():
        assert getattr(plan, name).shape == (count, *shape), name
    assert set(plan.status.tolist()) <= set(_core.POSITION_STATUS)
    assert np.linalg.norm(plan.axis, axis=1) == pytest.approx(np.ones(count))
    on_path = plan.path.position[plan.path.position >= 0]
    assert sorted(on_path.tolist()) == np.flatnonzero(plan.usable).tolist()
    reached = plan.path.position >= 0
    assert (plan.path.tip[reached] == plan.tip[on_path]).all()
    assert plan.path.kind[0] == "rapid" and plan.path.kind[-1] in ("rapid", "retract")
    assert plan.report.positions.count == count
    assert plan.program.text.startswith("%MPM01 G71 *")


def test_contacts_touch_tool_and_surface(coarse_job: Job) -> None:
    plan = planning.plan(coarse_job)
    tool = native_tool(coarse_job.tool)
    for tip, axis, contacts in zip(plan.tip, plan.axis, plan.contacts):
        distances = tool.signed_distance(tip, axis, contacts[np.isfinite(contacts).all(axis=1)])
        assert np.abs(distances).max() < 0.02


def test_the_default_method_proves_its_positions(coarse_job: Job) -> None:
    plan = planning.plan(
        replace(coarse_job, method=MethodSpec(), tolerance=Tolerance(gouge_mm=0.001, chord_mm=2.0))
    )
    assert plan.report.positions.guarantee == "proven"
    assert plan.clearance[:, 0].min() >= -0.001
    assert (plan.clearance[:, 0] <= plan.clearance[:, 1]).all()
    assert plan.report.verdict.line == "good (positions, cuts and links proven)"


def same_results(plan: Plan) -> tuple[str, str]:
    return cl_file.to_csv(plan.positions, plan.path), plan.program.text


@pytest.mark.parametrize("gouge_mm", [1e-2, 1e-5])
def test_positions_are_proven_to_the_jobs_own_tolerance(coarse_job: Job, gouge_mm: float) -> None:
    tolerance = Tolerance(gouge_mm=gouge_mm, chord_mm=1.0)
    plan = planning.plan(replace(coarse_job, method=MethodSpec("exact"), tolerance=tolerance))
    lower = plan.clearance[plan.usable, 0]
    # Where nothing cuts in, the proof goes about as far as it is asked to.
    assert -gouge_mm <= lower.min() < -gouge_mm / 10


def test_an_option_of_the_method_goes_before_the_jobs_tolerance(coarse_job: Job) -> None:
    own = replace(coarse_job, method=MethodSpec("exact", options={"gouge_mm": 1e-4}))
    assert method_options(own) == {"gouge_mm": 1e-4}
    assert method_options(replace(own, method=MethodSpec("exact"))) == {"gouge_mm": 0.02}
    assert method_options(replace(own, method=MethodSpec("vcrf"))) == {}


@pytest.mark.parametrize("method", method_names())
def test_any_number_of_threads_gives_the_same_bytes(coarse_job: Job, method: str) -> None:
    coarse_job = replace(coarse_job, method=MethodSpec(method))
    one, two, all_cores = (planning.plan(coarse_job, threads=threads) for threads in (1, 2, 0))
    assert same_results(one) == same_results(two) == same_results(all_cores)


def test_a_turned_part_in_a_turned_set_up_gives_the_turned_plan(coarse_job: Job) -> None:
    """The set-up is the turned part's own frame, so that nothing but rounding changes in it."""
    setup = Setup(origin=(100.0, -20.0, 7.0), z=(0.0, -0.6, 0.8), x=(1.0, 0.0, 0.0))
    frame = frame_of(setup)
    faces = [replace(face, poles=frame.to_part(face.poles)) for face in read_part(coarse_job.part.file)]
    straight, turned = planning.plan(coarse_job), planning.plan(replace(coarse_job, setup=setup), faces=faces)
    settled = (straight.clearance[:, 1] > -1e-4) & (straight.status == turned.status)
    assert settled.mean() > 0.5
    assert frame.to_setup(turned.tip)[settled] == pytest.approx(straight.tip[settled], abs=1e-3)
    assert frame.direction_to_setup(turned.axis)[settled] == pytest.approx(straight.axis[settled], abs=1e-3)


def test_only_the_named_faces_are_machined(coarse_job: Job) -> None:
    (left,) = read_part(coarse_job.part.file)
    right = replace(left, name="Face2", poles=left.poles + [200.0, 0.0, 0.0])
    named = replace(coarse_job, part=replace(coarse_job.part, faces=("Face2",)))
    plan = planning.plan(named, faces=[left, right])
    assert len(plan) == 28
    assert plan.contacts[:, 0, 0].min() >= 199.0
    both = planning.plan(coarse_job, faces=[left, right])
    assert both.contacts[:, 0, 0].min() < 50.0 and both.contacts[:, 0, 0].max() > 300.0


def test_other_faces_are_kept_clear_of(coarse_job: Job) -> None:
    """A wall stands on the part, 20 mm high at y = 70: no pose near it stays as it was, and none cuts it."""
    (ground,) = read_part(coarse_job.part.file)
    wall = replace(ground, name="Wall", poles=ground.poles * [1.0, 0.0, 1.0] + [0.0, 70.0, 20.0])
    named = replace(coarse_job, part=replace(coarse_job.part, faces=("Face1",)))
    without, with_wall = planning.plan(named, faces=[ground]), planning.plan(named, faces=[ground, wall])
    near = np.abs(without.tip[:, 1] - 70.0) < coarse_job.tool.radius_mm
    assert near.any()
    assert (np.abs(with_wall.tip - without.tip)[near].max(axis=1) < 1.0).sum() == 0
    assert with_wall.clearance[with_wall.usable, 1].min() > -coarse_job.tolerance.gouge_mm


def test_runs_end_where_points_are_left_out() -> None:
    passes = np.array([0, 0, 0, 0, 1, 1, 2, 2, 2])
    keep = np.array([1, 0, 1, 1, 1, 1, 0, 0, 1], dtype=bool)
    assert unbroken_runs(passes, keep).tolist() == [0, 1, 1, 2, 2, 3]


WRONG_JOBS = [
    ({"method": MethodSpec(name="vcfr")}, r"\[method\] name: unknown method 'vcfr'; did you mean vcrf\?"),
    (
        {"method": MethodSpec("vcrf", options={"division": 3})},
        r"\[method\] options.division: unknown .* mean divisions\?",
    ),
    (
        {"method": MethodSpec("vcrf", options={"divisions": "3"})},
        r"\[method\] options.divisions: must be a number, got '3'",
    ),
    ({"method": MethodSpec("vcrf", options={"divisions": -3})}, r"\[method\] divisions"),
    ({"method": MethodSpec("vcrf", spin_deg=5)}, r"\[method\] spin_deg: vcrf cannot spin"),
    (
        {"footprint": FootprintSpec(side_step_mm=1e-4)},
        r"\[footprint\] side_step_mm, forward_step_mm: .* more than 10000000 positions",
    ),
    ({"footprint": FootprintSpec(margin_mm=-80)}, r"\[footprint\] margin_mm: takes off the whole region"),
]


@pytest.mark.parametrize(("change", "message"), WRONG_JOBS)
def test_a_job_that_cannot_be_computed_is_refused(
    coarse_job: Job, change: dict[str, object], message: str
) -> None:
    with pytest.raises(InputError, match=f"^job: {message}"):
        planning.plan(replace(coarse_job, **change))


def test_progress_is_reported_stage_by_stage_in_the_callers_thread(coarse_job: Job) -> None:
    seen: list[tuple[str, float]] = []
    threads = set()

    def on_progress(stage: str, fraction: float) -> None:
        seen.append((stage, fraction))
        threads.add(threading.current_thread())

    plan = planning.plan(coarse_job, on_progress=on_progress)
    assert list(dict.fromkeys(stage for stage, _ in seen)) == list(plan.report.time.stages_s)
    assert all(0.0 <= fraction <= 1.0 for _, fraction in seen)
    assert threads == {threading.current_thread()}


@pytest.mark.parametrize("stage", ["positions", "judge", "path"])
def test_a_cancel_stops_any_long_stage_soon(thesis_job: Job, stage: str) -> None:
    """Footprints fine enough that the stage takes long; cancelled a little after it began."""
    step = {"positions": 0.2, "judge": 1.0, "path": 2.0}[stage]
    fine = replace(thesis_job, footprint=FootprintSpec(side_step_mm=step * 5, forward_step_mm=step))
    cancel = threading.Event()
    stopped = []

    def on_progress(now: str, fraction: float) -> None:
        if now == stage and 0.0 < fraction < 1.0 and not cancel.is_set():
            cancel.set()
            stopped.append(time.process_time())

    with pytest.raises(Cancelled):
        planning.plan(fine, on_progress=on_progress, cancel=cancel, threads=THREADS)
    assert time.process_time() - stopped[0] < THREADS * CANCEL_S + SLACK_S


def test_cancel_may_be_a_function(coarse_job: Job) -> None:
    with pytest.raises(Cancelled):
        planning.plan(coarse_job, cancel=lambda: True)


def test_the_package_offers_plan(job_file: Path) -> None:
    import freecad_mpm

    assert len(freecad_mpm.plan(job.load(job_file))) == 28
