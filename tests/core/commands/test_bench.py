"""The command `bench`: rows, pages, CSV."""

from __future__ import annotations

import csv
import json
from pathlib import Path

from command_line import run


def test_bench_prints_and_writes_rows(job_file: Path, tmp_path: Path) -> None:
    status, text, error = run("bench", "--surfaces", job_file, "--methods", "vcrf", "--out", tmp_path)
    assert (status, error) == (0, "")
    rows = json.loads((tmp_path / "bench.json").read_text())["rows"]
    wanted = {"method", "surface", "threads", "positions", "positions_per_second", "evaluations_per_position"}
    assert rows and all(wanted <= set(row) for row in rows)
    assert {(row["method"], row["surface"], row["positions"]) for row in rows} == {("vcrf", "job", 28)}
    assert rows[0]["threads"] == 1 and rows[0]["positions_per_second"] > 0
    assert rows[0]["evaluations_per_position"] > 1000
    assert "vcrf" in text
    assert 0.5 < rows[0]["two_contacts"] <= 1
    assert rows[0]["worst_gouge_mm"] >= rows[0]["deep_gouge_mm"]
    assert (tmp_path / "bench.png").read_bytes().startswith(b"\x89PNG")


def test_bench_writes_its_tables_into_pages_and_names_one_without_a_block(
    job_file: Path, tmp_path: Path
) -> None:
    page = tmp_path / "page.md"
    page.write_text("Before\n<!-- begin summary -->\nold\n<!-- end summary -->\nafter\n")
    arguments = ("--surfaces", job_file, "--methods", "exact", "--threads", "1", "--out", tmp_path)
    assert run("bench", *arguments, "--markdown", page)[0] == 0
    text = page.read_text()
    assert text.startswith("Before\n") and text.endswith("after\n") and "| `exact` |" in text
    page.write_text("nothing")
    status, _, error = run("bench", *arguments, "--markdown", page)
    assert status == 2 and "page.md: has none of the blocks" in error and page.read_text() == "nothing"


def test_bench_writes_the_rows_as_csv_too(job_file: Path, tmp_path: Path) -> None:
    arguments = ("--surfaces", job_file, "--methods", "dtm", "--threads", "1", "--out", tmp_path)
    assert run("bench", *arguments, "--csv", "bench.csv")[0] == 0
    row = json.loads((tmp_path / "bench.json").read_text())["rows"][0]
    head, line = list(csv.reader((tmp_path / "bench.csv").read_text().splitlines()))
    assert head == list(row) and dict(zip(head, line))["method"] == "dtm"
    assert row["seeds_per_position"] >= 1 and row["newton_steps_per_position"] > 1
