"""A key of the job is told once: its page, its unit and its use agree with that, and each check here can fail."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from cut_samples import plane, scene_of

from freecad_mpm.core import job
from freecad_mpm.core.base import Key, Stages, pages, values
from freecad_mpm.core.base.tables import ENDINGS
from freecad_mpm.core.job import KEYS, FootprintSpec, Job, Part, Segment, ToolSpec, words
from freecad_mpm.core.positioning import lay_out

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs/job-file.md"
COMMAND = "scripts/job_page.py"
ALL_KEYS = (*KEYS.values(), *Segment.keys())
PLANTED = Key("footprint", "planted_step_mm", 1.0, values.positive("degrees"), "nothing.")
# Where keys are told, not used.
TOLD = {ROOT / "freecad_mpm/core/job" / name for name in ("tables.py", "tool.py", "file.py", "words.py")}
# Keys that nobody else reads, and why.
NOT_USED = {
    "footprint.pattern": "its check refuses any other than the one there is",
    "tool.name": "only said, by `ToolSpec.describe` and in FreeCAD",
}


def unused(keys: Iterable[Key]) -> set[str]:
    """Full names of the keys that no other file of core reads as `table.key`, `spec.key` and the like."""
    read = {
        (ast.unparse(node.value).split(".")[-1], node.attr)
        for path in (ROOT / "freecad_mpm/core").rglob("*.py")
        if path not in TOLD
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.Attribute)
    }
    return {one.full_name for one in keys if not {(one.table, one.name), ("spec", one.name)} & read}


def badly_told(one: Key) -> list[str]:
    """What is wrong with the words and the unit of a key."""
    wrong = [] if re.fullmatch(r"[A-Z].*[^.]", one.words) else ["not a sentence without its full stop"]
    unit = next((unit for unit, ending in ENDINGS.items() if one.name.endswith(ending)), "")
    return wrong if unit == one.check.unit else [*wrong, "name and check have different units"]


def page_with(tables: str) -> str:
    return pages.replaced(PAGE.read_text(), {"keys": tables}, PAGE.name)


def test_the_page_of_the_job_file_is_that_of_the_code() -> None:
    assert PAGE.read_text() == page_with(words.page_tables()), f"docs/job-file.md is old: run {COMMAND}"
    assert (ROOT / COMMAND).exists() and COMMAND in (ROOT / "CONTRIBUTING.md").read_text()
    assert PAGE.read_text() != page_with(words.page_tables().replace("| `5.0` |", "| `18.0` |"))


def test_the_example_of_the_page_can_be_loaded(tmp_path: Path) -> None:
    text = re.search(r"```toml\n(.*?)```", PAGE.read_text(), re.DOTALL)
    assert text
    (tmp_path / "job.toml").write_text(text[1])
    assert job.load(tmp_path / "job.toml").footprint.zigzag


@pytest.mark.parametrize("one", ALL_KEYS, ids=lambda one: one.full_name)
def test_a_key_is_told_well(one: Key) -> None:
    assert badly_told(one) == []


def test_a_key_told_badly_is_found() -> None:
    assert len(badly_told(PLANTED)) == 2


def test_every_key_is_used() -> None:
    assert unused(KEYS.values()) == set(NOT_USED)


def test_a_key_that_nobody_uses_is_found() -> None:
    assert unused([PLANTED]) == {PLANTED.full_name}


def test_a_report_says_every_value_of_a_job() -> None:
    made = Job(Part("a.step"), ToolSpec(4, 1), footprint=FootprintSpec(margin_mm=-1.5, allow_gaps=True))
    text = "\n".join(words.job_lines(asdict(made)))
    assert "side step 5 mm" in text and "margin -1.5 mm, allow gaps yes" in text
    assert all(one.label in text for one in KEYS.values() if one.default not in ((), {}, ""))


@pytest.mark.parametrize("margin", [5.0, -5.0])
def test_the_margin_is_what_its_words_say(margin: float) -> None:
    """Beyond the faces, or inside the rectangle round them."""
    made = Job(Part("flat"), ToolSpec(4, 1), footprint=FootprintSpec(side_step_mm=10, margin_mm=margin))
    points = lay_out(made, scene_of(plane(0.0)), Stages()).points
    flat = np.ptp(points, axis=0)
    assert flat == pytest.approx(40 + 2 * margin) and points.mean(axis=0) == pytest.approx([20, 20])
