"""The shares of the two tolerances add up."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from freecad_mpm.core.job import PROVEN, Job, Part, PostSpec, Tolerance, ToolSpec, budget

JOB = Job(part=Part("none"), tool=ToolSpec(6.7, 6.0), tolerance=Tolerance(gouge_mm=0.001, chord_mm=0.04))


@pytest.mark.parametrize("tcp", [True, False])
def test_what_is_certified_and_what_the_control_may_take_make_the_depth_of_a_cut(tcp: bool) -> None:
    job = replace(JOB, post=PostSpec(tcp=tcp))
    depth = budget.cut_depth_mm(job.tolerance, PROVEN)
    assert budget.certified_depth_mm(job, depth) + budget.control_tip_deviation_mm(job) == depth == 0.04
    assert budget.control_tip_deviation_mm(job) == (0.0 if tcp else 0.01)


def test_the_axis_share_moves_the_rim_by_its_share_of_the_chord() -> None:
    rim = np.radians(budget.control_deviation_deg(JOB)) * JOB.tool.radius_mm
    assert rim == pytest.approx(budget.CONTROL_SHARE * JOB.tolerance.chord_mm, rel=1e-12)


def test_all_shares_of_the_control_leave_most_of_the_chord_to_the_cut() -> None:
    assert 2 * budget.CONTROL_SHARE * budget.WORD_SLACK < 1 - budget.CONTROL_SHARE


@pytest.mark.parametrize(("gouge", "chord"), [(0.001, 0.01), (0.02, 0.01), (0.01, 0.01)])
def test_a_cut_may_go_no_less_deep_than_its_ends(gouge: float, chord: float) -> None:
    tolerance = Tolerance(gouge_mm=gouge, chord_mm=chord)
    assert budget.cut_depth_mm(tolerance, PROVEN) == max(gouge, chord)
    assert budget.cut_depth_mm(tolerance, "sampled") == gouge + chord
