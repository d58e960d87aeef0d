"""The command `plan`: results, exit status."""

from __future__ import annotations

import json
from pathlib import Path

from command_line import run

RESULTS = {"cl.csv", "cl.apt", "program.I", "report.json", "report.txt", "machined.stl", "path.png"}


def test_plan_writes_all_results_and_says_where(job_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    status, text, error = run("plan", job_file, "--out", out)
    assert (status, error) == (0, "")
    assert {path.name for path in out.iterdir()} == RESULTS
    assert all(str(out / name) in text for name in RESULTS)
    assert "sampled: no proof" in text
    report = json.loads((out / "report.json").read_text())
    assert report["positions"]["count"] == 28 and report["verdict"]["good"] is True
    assert (out / "report.txt").read_text() in text


def test_a_plan_with_gouges_is_written_and_has_status_1(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("chord_mm = 2.0", "chord_mm = 1e-6"))
    status, text, error = run("plan", job_file, "--out", tmp_path / "out")
    assert (status, error) == (1, "")
    assert "NOT GOOD" in text and (tmp_path / "out" / "cl.csv").exists()


def test_threads_do_not_change_the_results(job_file: Path, tmp_path: Path) -> None:
    for threads in (1, 2):
        assert run("plan", job_file, "--out", tmp_path / str(threads), "--threads", threads)[0] == 0
    for name in sorted(RESULTS - {"report.json", "report.txt"}):  # these hold times
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes(), name


def test_a_plan_that_leaves_cuts_out_is_not_good(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("allow_gaps = true", ""))
    status, text, error = run("plan", job_file, "--out", tmp_path / "out")
    assert (status, error) == (1, "")
    assert text.startswith("Verdict: NOT GOOD: 10 moves between neighbours of a pass are not cut (")
    worst = json.loads((tmp_path / "out" / "report.json").read_text())["cut"]["worst_gouge"]
    assert f"Worst gouge: {worst['deviation_mm']:+.4f} mm at" in text
    assert (
        f"(cut, pass {worst['pass_index']}, position {worst['position']}); {worst['depth_mm']:.4f} mm inside the tool"
        in text
    )
    # Between positions 25 mm apart the chord cuts in; the tool's own depth is what the chord tolerance is about.
    assert 0.02 < worst["depth_mm"] <= -worst["deviation_mm"] + 1e-4 and worst["depth_mm"] < 2.0
