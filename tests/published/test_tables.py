"""The thesis' tables 2 and 3: what removal finds on our paths, beside its simulated columns (docs/removal.md)."""

from __future__ import annotations

import json

import pytest

from freecad_mpm.core.bench import published
from freecad_mpm.core.bench.published import CASES, EXCHANGED, THESIS

BY_LABEL = {case.label: case for case in CASES}
CLOSE_MM = 0.05


def row(surface: str, label: str) -> dict:
    return published.measure(surface, BY_LABEL[label]).row


@pytest.mark.parametrize("surface", ["convex", "concave", "saddle"])
def test_vcrf_leaves_what_the_thesis_simulated(surface: str) -> None:
    found = row(surface, "VCRF")
    assert found["interior_mm"][1] == pytest.approx(THESIS["vcrf", surface][1], abs=CLOSE_MM)
    # No printed minimum can be signed: a sampled method cuts in by micrometres.
    assert -0.01 < found["interior_mm"][0] <= 1e-6


def test_vcrf_fits_the_saddle_better_with_exchanged_indices() -> None:
    assert row(EXCHANGED, "VCRF")["interior_mm"][1] == pytest.approx(0.62, abs=0.005)


def test_drd_leaves_what_the_thesis_simulated_where_the_patch_goes_on() -> None:
    assert row("convex", "DRD, continued")["all_mm"][1] == pytest.approx(0.54, abs=0.01)
    assert row(EXCHANGED, "DRD, continued")["all_mm"][1] == pytest.approx(0.79, abs=0.01)


def test_drd_on_the_concave_part_lies_between_both_ways_to_treat_the_border() -> None:
    """The printed 0.92 is neither 0.64, with the patch continued, nor 1.49, with nothing beyond it."""
    continued, as_is = (row("concave", label)["all_mm"][1] for label in ("DRD, continued", "DRD"))
    assert continued == pytest.approx(0.636, abs=0.01) and as_is == pytest.approx(1.488, abs=0.02)
    assert continued < THESIS["drd", "concave"][1] < as_is


@pytest.mark.parametrize("surface", ["convex", "saddle"])
def test_exact_leaves_no_gouge_and_no_more_than_vcrf(surface: str) -> None:
    found = row(surface, "exact")
    assert found["all_mm"][0] > -0.01  # the chord tolerance
    assert found["interior_mm"][1] < THESIS["vcrf", surface][1] + CLOSE_MM


def test_three_axes_leave_several_times_as_much() -> None:
    """A ball of radius R leaves R - sqrt(R^2 - s^2 / 4) on level ground, 3.72 mm at s = 18 mm."""
    level = 12.7 - (12.7**2 - 9.0**2) ** 0.5
    assert row("convex", "three axes, ball")["interior_mm"][1] == pytest.approx(level, abs=0.1)
    assert 1.5 < row("convex", "three axes, same cutter")["interior_mm"][1] < 2.5


def test_the_files_hold_every_row() -> None:
    measured = [published.measure("convex", BY_LABEL["exact"])]
    files = published.files(measured)
    assert set(files) == {"published.json", "published.txt", "published_convex.png"}
    rows = json.loads(files["published.json"])["rows"]
    assert [one["case"] for one in rows] == ["exact"]
    assert "exact" in published.table(rows)
