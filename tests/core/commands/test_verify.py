"""The command `verify`."""

from __future__ import annotations

from pathlib import Path

from command_line import run


def test_verify_agrees_with_plan_and_finds_a_spoilt_pose(job_file: Path, tmp_path: Path) -> None:
    assert run("plan", job_file, "--out", tmp_path)[0] == 0
    status, text, error = run("verify", job_file, tmp_path / "cl.csv")
    assert (status, error) == (0, "")
    lines = (tmp_path / "cl.csv").read_text().splitlines()
    number, line = next((i, line) for i, line in enumerate(lines) if ",cut," in line)
    cells = line.split(",")
    cells[6] = str(float(cells[6]) - 1.0)  # tip_z
    (tmp_path / "spoilt.csv").write_text("\n".join([*lines[:number], ",".join(cells), *lines[number + 1 :]]))
    status, text, error = run("verify", job_file, tmp_path / "spoilt.csv")
    assert (status, error) == (1, "")
    assert "NOT GOOD" in text and f"line {number + 1} " in text
