"""Placing through its Python door: what nobody can go to is no position."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from cut_samples import plane, scene_of

from freecad_mpm.core import planning
from freecad_mpm.core.base import InputError, Stages
from freecad_mpm.core.job import FootprintSpec, Job, MethodSpec, Part, ToolSpec
from freecad_mpm.core.positioning import lay_out, make_positioner, place

BULL = ToolSpec(3.0, 2.0)
STEEP = 1.8  # the wall leans 61 degrees: turned by 180 degrees about its normal the upright axis points down


def job_of(spin_deg: float, tool: ToolSpec = BULL) -> Job:
    return Job(
        part=Part("none"),
        tool=tool,
        footprint=FootprintSpec(side_step_mm=10.0, forward_step_mm=5.0, margin_mm=-5.0),
        method=MethodSpec(spin_deg=spin_deg, tilt_max_deg=5.0),
    )


def test_an_axis_under_the_horizon_is_no_position_but_undecided() -> None:
    job, stages = job_of(180.0), Stages()
    scene = scene_of(plane(STEEP), BULL)
    positioner = make_positioner(job, scene, stages)
    found, _, _ = place(job, scene, positioner, lay_out(job, scene, stages), stages)
    below = found.axis[:, 2] <= 0.0
    assert below.any() and (found.status[below] == "undecided").all() and not found.usable[below].any()


def test_a_plan_goes_on_without_them_or_says_that_there_is_none() -> None:
    with pytest.raises(
        InputError, match=r"job: \[method\] name: exact found no usable position .*: [0-9]+ undecided$"
    ):
        planning.plan(job_of(180.0), faces=[plane(STEEP)])
    # A gentle slope beside the wall: its positions are taken all the same.
    gentle = plane(0.1)
    aside = replace(gentle, name="Face2", poles=gentle.poles + np.array([60.0, 0.0, 0.0]))
    plan = planning.plan(job_of(180.0), faces=[plane(STEEP), aside])
    assert plan.usable.any() and not plan.usable.all()
    assert not plan.report.verdict.good and "undecided" in plan.report.verdict.line


def test_what_a_method_objects_to_is_named_by_the_table_that_has_it() -> None:
    with pytest.raises(InputError, match=r"^job: \[tool\] minor_radius_mm: exact needs a rounded ring"):
        planning.plan(job_of(0.0, ToolSpec(5.0, 0.0)), faces=[plane(0.1)])
