"""Figures of a program."""

from __future__ import annotations

import numpy as np
import pytest
from machine_samples import dmu80p, program_of, two_passes

from freecad_mpm.core.control import check_program
from freecad_mpm.core.control.dialects.din_iso import read
from freecad_mpm.core.posts.dmu80p import write
from freecad_mpm.core.program import report as program_report

KIND, TIP, AXIS, FEED = two_passes()
GOOD = write(program_of(KIND, TIP, AXIS, FEED))


def test_report_tells_lengths_times_ranges_and_errors():
    program = program_of(KIND, TIP, AXIS, FEED)
    parsed = read(GOOD)
    report = program_report.report(program, len(parsed.blocks), check_program(parsed, dmu80p(), TIP, AXIS))
    cuts = np.linalg.norm(np.diff(TIP, axis=0), axis=1)[KIND[1:] == "cut"].sum()
    assert report.length_mm["cut"] == pytest.approx(cuts, rel=1e-9)
    assert report.time_s["cut"] >= cuts / 1500.0 * 60.0 * 0.999
    assert report.axes["B"].low > 0 and report.axes["C"].high - report.axes["C"].low > 360
    assert report.largest_step_deg["C"] <= 10.0
    assert report.pole_passages == 0
    text = "\n".join(report.lines())
    assert (
        "Text parsed back: tip error <= 0.0000" in text and "Checks: passed" in text and "no limits" in text
    )
    assert report.to_dict()["axes"]["C"]["max_limit"] is None


def test_report_counts_pole_passages_between_the_poses():
    count = 9
    tip = np.column_stack((np.arange(count), np.zeros(count), np.zeros(count)))
    x = np.where(np.arange(count) % 2, 0.1, -0.1)  # to and fro over the pole, no pose in it
    axis = np.column_stack((x, np.full(count, 0.001), np.ones(count)))
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    kind = np.array(["rapid"] + ["cut"] * (count - 1))
    program = program_of(kind, tip, axis, np.full(count, 500.0))
    report = program_report.report(program, 0, check_program(read(write(program)), dmu80p()))
    assert report.pole_passages == count - 1
    assert report.nearest_to_pole_deg == pytest.approx(np.degrees(0.001), rel=0.1)
    assert "not compared with a CL list" in "\n".join(report.lines())
