"""A rotary axis that comes to its end in the middle of a pass: the tool retracts, turns clear of the part, and goes
on."""

import re

import numpy as np
import pytest
from part_samples import TOOL

from freecad_mpm.core import job, planning
from freecad_mpm.core.base import MACHINES
from freecad_mpm.core.commands import cli
from freecad_mpm.core.machine import rewinds

JOB = """
[part]
file = "{part}"
{tool}[footprint]
direction_deg = 20.0
side_step_mm = 30.0
forward_step_mm = 3.0
[machine]
name = "{machine}"
[post]
name = "{post}"
tcp = {tcp}
"""


@pytest.fixture
def limited(tmp_path):
    """The DMU 80P with a table that turns from -180 to 180 degrees and no farther."""
    text = (MACHINES / "dmu80p.toml").read_text()
    text = text.replace("min_limit_deg = -inf ", "min_limit_deg = -180.0 ").replace(
        "max_limit_deg = inf", "max_limit_deg = 180.0"
    )
    path = tmp_path / "limited.toml"
    path.write_text(text)
    return path


def job_file(machine, thesis_part, tmp_path, post="dmu80p", tcp="true"):
    path = tmp_path / "job.toml"
    path.write_text(JOB.format(tool=TOOL, part=thesis_part("convex"), machine=machine, post=post, tcp=tcp))
    return path


def plan_on(*arguments):
    return planning.plan(job.load(job_file(*arguments)))


@pytest.mark.parametrize("post, tcp", [("dmu80p", "true"), ("dmu80p", "false"), ("linuxcnc", "true")])
def test_the_tool_goes_up_turns_and_goes_on(limited, thesis_part, tmp_path, post, tcp):
    plan = plan_on(limited, thesis_part, tmp_path, post, tcp)
    assert plan.report.verdict.good, plan.report.verdict.line
    assert plan.path.proven.all()
    turned = rewinds(plan.path)
    assert len(turned) >= 1
    assert any("rewind on the safe plane, before positions" in line for line in plan.report.warnings)
    for position in turned:
        assert_interrupted(plan, int(np.flatnonzero(plan.path.position == position)[0]))


def assert_interrupted(plan, cut):
    """Before the cut: up to the safe plane, down again, and the plunge to where the tool left."""
    path = plan.path
    start = cut - 1 - path.kind[cut - 1 :: -1].tolist().index("retract") - 1
    assert (
        path.kind[start] == "cut" and path.position[start] == -1
    )  # the first piece, up to the table's limit
    assert_on_the_way(path, start, cut)
    kinds = path.kind[start + 1 : cut].tolist()
    assert (kinds[0], set(kinds[1:-1]), kinds[-1]) == ("retract", {"rapid"}, "plunge")
    assert np.abs(path.tip[cut - 1] - path.tip[start]).max() < 1e-9
    top = path.tip[start + 1 : cut, 2].max()
    assert top > plan.path.tip[path.position >= 0][:, 2].max()
    assert path.clearance[start + 2 : cut - 1].min() >= 0 and not path.blocked[start:cut].any()
    assert (
        path.clearance[start + 1] >= -plan.job.tolerance.chord_mm
    )  # the retract begins within the cut's chord
    # the turn itself: at the top with the tip held, or above it
    rows = np.flatnonzero((plan.joints.move > start) & (plan.joints.move < cut))
    turn = np.abs(np.diff(plan.joints.rotary_deg[:, 0]))[rows - 1]
    turning = rows[turn > 90.0]
    assert len(turning) == 1 and plan.joints.kind[turning[0]] == "rapid"
    assert plan.joints.tip[turning[0], 2] >= top - 1e-9


def assert_on_the_way(path, middle, end):
    """The piece ends on the line and the great circle of the whole cut."""
    a, b = middle - 1, end
    way, part = path.tip[b] - path.tip[a], path.tip[middle] - path.tip[a]
    fraction = part @ way / (way @ way)
    assert 0 < fraction < 1 and np.abs(part - fraction * way).max() < 1e-9
    assert abs(np.cross(path.axis[a], path.axis[b]) @ path.axis[middle]) < 1e-9


def test_an_endless_table_needs_none(thesis_part, tmp_path):
    plan = plan_on("dmu80p", thesis_part, tmp_path)
    assert len(rewinds(plan.path)) == 0 and plan.report.verdict.good


def test_cuts_are_as_many_and_as_proven_as_without(limited, thesis_part, tmp_path):
    with_limits = plan_on(limited, thesis_part, tmp_path).path
    without = plan_on("dmu80p", thesis_part, tmp_path).path
    cuts = [(one.kind == "cut") & (one.position >= 0) for one in (with_limits, without)]
    assert np.array_equal(with_limits.position[cuts[0]], without.position[cuts[1]])
    assert np.array_equal(with_limits.clearance[cuts[0]], without.clearance[cuts[1]])


def test_a_rotary_axis_that_cannot_help_is_told_with_its_position(limited, thesis_part, tmp_path):
    limited.write_text(
        re.sub(r"max_limit_deg = 180.0( +# spindle)", r"max_limit_deg = 2.0\1", limited.read_text())
    )
    plan = plan_on(limited, thesis_part, tmp_path)
    assert not plan.report.verdict.good
    assert re.search(
        r"a rotary axis leaves its limits: \d+ moves, the first in move \d+ at position \d+",
        plan.report.verdict.line,
    )


def test_the_cl_file_and_the_program_of_such_a_plan_pass_their_checks(limited, thesis_part, tmp_path):
    job_file(limited, thesis_part, tmp_path)
    assert cli.main(["plan", str(tmp_path / "job.toml"), "--out", str(tmp_path)]) == 0
    assert cli.main(["verify", str(tmp_path / "job.toml"), str(tmp_path / "cl.csv")]) == 0
    program, against = str(tmp_path / "program.I"), str(tmp_path / "cl.csv")
    assert cli.main(["check", program, "--machine", str(limited), "--against", against]) == 0
    lower_the_place_between(tmp_path / "cl.csv", 0.02)  # more than the 0.01 mm that a cut may be deep
    assert cli.main(["verify", str(tmp_path / "job.toml"), str(tmp_path / "cl.csv")]) == 1


def lower_the_place_between(path, depth_mm):
    """In a CL file, of the first cut that ends between positions."""
    lines = path.read_text().split("\n")
    row = next(i for i, line in enumerate(lines) if line.split(",")[1:3] == ["-1", "cut"])
    cells, z = lines[row].split(","), lines[0].split(",").index("tip_z")
    cells[z] = f"{float(cells[z]) - depth_mm:.9f}"
    path.write_text("\n".join([*lines[:row], ",".join(cells), *lines[row + 1 :]]))
