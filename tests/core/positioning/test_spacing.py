"""A wanted contact spacing through the whole chain: job, plan, report; and the spread over all spins."""

from __future__ import annotations

import csv
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core import job, planning
from freecad_mpm.core.base import EXAMPLES, TOOLS, InputError, Stages
from freecad_mpm.core.job import FootprintSpec, Job, MethodSpec, Part, Setup
from freecad_mpm.core.job import tool as tools
from freecad_mpm.core.part import prepare
from freecad_mpm.core.path import cl_file, judge
from freecad_mpm.core.path.cuts import middle_angle_deg
from freecad_mpm.core.planning import Plan
from freecad_mpm.core.positioning import spins
from freecad_mpm.core.report import text as report

WANTED_MM = 8.0


@pytest.fixture(scope="module")
def saddle_job(thesis_part: Callable[[str], Path]) -> Job:
    return Job(
        part=Part(file=str(thesis_part("saddle"))),
        tool=tools.load(TOOLS / "thesis.toml"),
        footprint=FootprintSpec(side_step_mm=37.5, forward_step_mm=3, margin_mm=-5.0),
        method=MethodSpec(contact_spacing_mm=WANTED_MM, spacing_measure="direct"),
    )


@pytest.fixture(scope="module")
def plan(saddle_job: Job) -> Plan:
    return planning.plan(saddle_job)


def distance(plan: Plan) -> np.ndarray:
    return np.linalg.norm(plan.contacts[:, 1] - plan.contacts[:, 0], axis=1)


def test_every_position_of_the_footprint_has_the_spacing(plan: Plan) -> None:
    assert distance(plan)[~plan.inserted] == pytest.approx(WANTED_MM, rel=0.01)
    plain = planning.plan(replace(plan.job, method=MethodSpec()))
    assert np.nanstd(distance(plain)) > 2  # without it, it is anything


def test_the_plan_is_proven_as_for_any_spin(plan: Plan, tmp_path: Path) -> None:
    assert plan.report.verdict.good
    assert plan.report.path.moves_not_cut == 0
    assert plan.report.statement.endswith("proven")
    (tmp_path / "cl.csv").write_text(cl_file.to_csv(plan.positions, plan.path))
    assert judge.verify(plan.job, cl_file.read_csv(tmp_path / "cl.csv"), Stages()).good


def test_the_report_says_how_well_it_was_kept(plan: Plan) -> None:
    count = np.count_nonzero(~plan.inserted)
    said = f"Contacts 8 mm apart from contact to contact: within 1% at {count} of {count} positions of the footprint"
    text = report(plan.report)
    assert said in text and "contact spacing 8 mm" in text


def test_what_cannot_be_reached_is_told_with_the_nearest(saddle_job: Job) -> None:
    wide = replace(saddle_job, method=MethodSpec(contact_spacing_mm=30.0))
    found = planning.plan(wide).report.contact_spacing
    assert found.kept == 0 and len(found.unreachable) == found.footprint
    nearest = [one["nearest_mm"] for one in found.unreachable]
    assert max(nearest) < 2 * wide.tool.radius_mm
    assert f"no spin gives it, the nearest is {min(nearest):.2f} to" in found.sentence


def test_a_turned_part_keeps_the_spacing_across_its_feed(saddle_job: Job) -> None:
    """The spacing is measured in the set-up frame, whose x axis is here the part's y."""
    turned = replace(
        saddle_job,
        setup=Setup(x=(0.0, 1.0, 0.0)),
        method=MethodSpec(contact_spacing_mm=3.0),
        footprint=replace(saddle_job.footprint, direction_deg=0.0),
    )
    plan = planning.plan(turned)
    apart = plan.contacts[:, 1] - plan.contacts[:, 0]
    across = np.hypot(apart[:, 0], apart[:, 2])  # the feed runs along the part's y
    kept = np.abs(across - 3.0) <= 0.03
    assert np.count_nonzero(kept) == plan.report.contact_spacing.kept > 0.8 * len(kept)


@pytest.mark.parametrize(
    ("method", "message"),
    [
        (
            dict(name="vcrf", contact_spacing_mm=8.0),
            "must be 0 for vcrf, which cannot spin; exact and dstm can",
        ),
        (dict(name="dtm", contact_spacing_mm=8.0), "must be 0 for dtm"),
    ],
)
def test_methods_that_cannot_spin_refuse_it(saddle_job: Job, method: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        planning.plan(replace(saddle_job, method=MethodSpec(**method)))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (dict(contact_spacing_mm=8.0, spin_deg=5.0), "spin_deg: must be 0 when a contact spacing chooses"),
        (dict(contact_spacing_mm=-1.0), "contact_spacing_mm: must be zero or a positive number of mm"),
        (dict(spacing_measure="diagonal"), 'spacing_measure: must be "across" or "direct"'),
    ],
)
def test_wrong_values_are_named(values: dict, message: str) -> None:
    with pytest.raises(InputError, match=message):
        MethodSpec(**values)


def test_a_middle_angle_takes_the_shorter_way() -> None:
    a, b = np.array([10.0, 170.0, -170.0, 0.0]), np.array([30.0, -170.0, 170.0, 0.0])
    assert middle_angle_deg(a, b) % 360 == pytest.approx([20.0, 180.0, 180.0, 0.0])


def test_the_spread_agrees_with_one_spin_at_a_time(saddle_job: Job) -> None:
    scene = prepare(saddle_job, None, Stages())
    points, spin_deg = np.array([[40.0, 60.0], [110.0, 90.0]]), np.array([-90.0, 0.0, 30.0])
    found = spins.spread(saddle_job, scene, points, spin_deg, 0.05, Stages())
    for k, one in enumerate(spin_deg):
        alone = _core.Positioner("exact", scene.model, scene.tool, spin_deg=one)
        placed = alone.place(points, context=_core.Context(1))
        np.testing.assert_array_equal(found.contacts[:, k], placed["contacts"])
    rows = list(csv.DictReader(spins.to_csv(found).splitlines()))
    assert len(rows) == 6 and float(rows[4]["spin_deg"]) == 0.0
    assert float(rows[5]["direct_mm"]) == pytest.approx(found.direct[1, 2], abs=1e-6)
    assert np.nanmax(found.across) <= np.nanmax(found.direct)


def test_the_shipped_example_wants_a_spacing() -> None:
    example = job.load(EXAMPLES / "saddle_strip.toml")
    assert example.method == MethodSpec(contact_spacing_mm=8.0, spacing_measure="direct")
