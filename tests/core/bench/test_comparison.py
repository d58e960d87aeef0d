"""The comparison: what it measures, and that the pages' tables are what it makes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from freecad_mpm import _core
from freecad_mpm.core.base import InputError, Stages, pages
from freecad_mpm.core.bench import comparison, degrees, picture, scaling, summary
from freecad_mpm.core.bench.comparison import Row
from freecad_mpm.core.bench.summary import Table
from freecad_mpm.core.part import FaceArrays, prepare
from freecad_mpm.core.part.faces import to_core
from freecad_mpm.core.positioning import method_names

ROOT = Path(__file__).resolve().parents[3]
README, COMPARISON = ROOT / "README.md", ROOT / "docs" / "comparison.md"
SUBSET = ("exact", "vcrf")
TIMES = ("time", "µs a position", "index, s", "times the base")


@pytest.fixture(scope="module")
def rows() -> list[Row]:
    """Two methods on all three surfaces, one thread."""
    return [comparison.measure(run) for run in comparison.runs(None, SUBSET, 1)]


def table_in(page: Path, name: str) -> list[dict[str, str]]:
    block = pages.block(page.read_text(), name)
    assert block, f"{page.name} has no block {name}"
    lines = [[cell.strip() for cell in line.strip("|").split("|")] for line in block.splitlines()]
    return [dict(zip(lines[0], line)) for line in lines[2:]]


def without_times(line: dict[str, str]) -> dict[str, str]:
    return {name: value for name, value in line.items() if name not in TIMES}


def as_lines(table: Table) -> list[dict[str, str]]:
    return [dict(zip(table.headings, map(str, row))) for row in table.rows]


@pytest.mark.parametrize(("page", "name"), [(README, "summary"), (COMPARISON, "comparison")])
def test_the_page_holds_what_a_run_counts(rows: list[Row], page: Path, name: str) -> None:
    """Written by `bench --threads 1 --markdown README.md docs/comparison.md`; times aside, it must not be stale."""
    printed = table_in(page, name)
    assert [line["method"] for line in printed] == [f"`{method}`" for method in method_names()]
    now = as_lines(summary.blocks(rows, [])[name])
    assert list(printed[0]) == list(now[0])
    for line in now:
        theirs = next(one for one in printed if one["method"] == line["method"])
        assert without_times(theirs) == without_times(line)


def test_the_pages_hold_every_claim_and_every_case() -> None:
    claims = [line["claim"] for line in table_in(COMPARISON, "claims")]
    names = [*comparison.DEFAULT_SURFACES, *(f"bi-degree {degree}" for degree in degrees.DEGREES)]
    assert claims[: len(names)] == [f"{name}: fewer than 5 seeds and 20 iterations" for name in names]
    assert len(claims) == len(names) + 2
    cases = {line["what"]: line for line in table_in(COMPARISON, "scaling")}
    assert list(cases) == [case.name for case in scaling.cases()]
    cells = {name: int(line["cells"]) for name, line in cases.items()}
    assert cells["coarse tolerance"] < cells["thesis' footprint"] < cells["fine tolerance"]


def test_time_is_that_of_the_positions_alone(rows: list[Row]) -> None:
    for row in rows:
        assert row["positions"] == 760
        assert row["positions_per_second"] == pytest.approx(1e6 / row["microseconds_per_position"])
    assert all(row["worst_gouge_mm"] <= 0.001 for row in rows if row["method"] == "exact")


def test_the_certificate_judges_and_not_the_method(rows: list[Row]) -> None:
    """vcrf calls none of its positions a gouge; the certificate finds what an independent re-implementation of the
    thesis has: 0.0032, 0.0040 and 0.0074 mm."""
    worst = {row["surface"]: row["worst_gouge_mm"] for row in rows if row["method"] == "vcrf"}
    right = {"convex": 0.0032, "concave": 0.0040, "saddle": 0.0074}
    assert worst == pytest.approx(right, abs=0.0002)
    assert all(row["gouging"] > 0 for row in rows if row["method"] == "vcrf")
    assert all(row["proven_gouge_mm"] <= 0.001 for row in rows if row["method"] == "exact")


def test_certificates_of_poses_agree_with_a_floor() -> None:
    knots = np.array([0.0, 0.0, 1.0, 1.0])
    poles = np.array([[[0, 0, 0], [0, 100, 0]], [[100, 0, 0], [100, 100, 0]]], dtype=float)
    floor = _core.SurfaceModel([to_core(FaceArrays("Face1", "plane", 1, 1, knots, knots, poles))])
    tips = np.array([[50.0, 50.0, 0.0], [50.0, 50.0, -0.25]])
    found = _core.certify_poses(
        floor,
        _core.Tool(6.7, 6.0, 6.0, 40.0),
        tips,
        np.tile([0.0, 0.0, 1.0], (2, 1)),
        tolerance_mm=0.001,
        context=_core.Context(2),
    )
    assert [_core.VERDICTS[code] for code in found["verdict"]] == ["free", "gouge"]
    assert found["lo"][1] <= -0.25 + 1e-9 and -0.25 - 1e-9 <= found["hi"][1] <= -0.25 / 1.001


@pytest.mark.parametrize("poles", [(7, 12), (4, 9)])
def test_a_refined_surface_is_the_same_surface(poles: tuple[int, int]) -> None:
    face = degrees.wave(3)
    fine = scaling.refine(face, poles)
    assert fine.poles.shape == (*poles, 3)
    u, v = np.random.default_rng(3).uniform(size=(2, 50))
    one, two = (
        _core.BSplineSurface(f.degree_u, f.degree_v, f.knots_u, f.knots_v, f.poles).evaluate(u, v)
        for f in (face, fine)
    )
    assert one == pytest.approx(two, abs=1e-9)


@pytest.mark.parametrize("degree", degrees.DEGREES)
def test_the_surfaces_by_degree_have_it_both_ways(degree: int) -> None:
    """The derivative of that order along a parameter line is constant and not zero: no lower degree would do."""
    face = degrees.wave(degree)
    assert face.poles.shape == (degree + 1, degree + 1, 3)
    for direction in (0, 1):
        highest = np.diff(face.poles[..., 2], n=degree, axis=direction)
        assert np.abs(highest).max() > 1


def test_the_picture_is_one(rows: list[Row]) -> None:
    assert picture.draw(rows).startswith(b"\x89PNG")


def test_blocks_are_replaced_and_a_page_without_any_is_named(tmp_path: Path) -> None:
    page = "a\n<!-- begin x -->\nold\n<!-- end x -->\nb\n<!-- begin y -->\n<!-- end y -->\n"
    now = pages.replaced(page, {"x": "new \\1", "z": "other"}, "page.md")
    assert now == page.replace("old", "new \\1")
    assert pages.replaced(now, {"x": "new \\1"}, "page.md") == now
    with pytest.raises(InputError, match="page.md: has none of the blocks <!-- begin z -->"):
        pages.replaced(page, {"z": "other"}, "page.md")
    with pytest.raises(InputError, match="nowhere.md: cannot be read"):
        pages.read(str(tmp_path / "nowhere.md"))


def test_a_row_counts_its_failures() -> None:
    (run,) = comparison.runs(["concave"], ["dtm"], 1)
    stages = Stages(threads=1)
    few = prepare(run.job, None, stages)
    row, positions = comparison.timed(run, few, stages)
    assert (
        row["failures"] == np.count_nonzero(~positions.usable) == 288
    )  # as an independent re-implementation
