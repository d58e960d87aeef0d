"""The command `cut`."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from command_line import run


def test_cut_measures_a_plan_and_its_files(job_file: Path, tmp_path: Path) -> None:
    assert run("plan", job_file, "--out", tmp_path / "plan")[0] == 0
    out = tmp_path / "cut"
    for source in ("cl.csv", "program.I"):
        status, text, error = run(
            *("cut", job_file, tmp_path / "plan" / source, "--out", out, "--resolution-mm", 6),
            *("--section", "y=27", "--probe-radius-mm", 2, "--mesh", "left.obj"),
        )
        assert (status, error) == (0, "")
        assert "Worst gouge: " in text and "Section y27:" in text and "by probe" in text
        names = {"cut.json", "cut.txt", "deviation.png", "section_y27.csv", "section_y27.png", "left.obj"}
        assert {path.name for path in out.iterdir()} == names
        facts = json.loads((out / "cut.json").read_text())
        assert facts["worst_gouge"]["move"] >= 0 and facts["sections"]["y27"]["max_mm"] > 1
        rows = list(csv.DictReader((out / "section_y27.csv").read_text().splitlines()))
        assert {float(row["y"]) for row in rows} == {27.0}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--resolution-mm", "0"], "--resolution-mm: must be a positive number"),
        (["--section", "w=3"], "--section: must be x=MM, y=MM, z=MM, line=X,Y:X,Y or point="),
        (["--section", "x=75", "--section", "z=300"], "--section z300: the plane does not meet the faces"),
        (["--mesh", "a.3mf"], "a.3mf: a mesh file must end in one of"),
        (["--resolution-mm", "0.0001"], "mm would fit, or a small box"),
    ],
)
def test_cut_says_what_is_wrong(words: list[str], said: str, job_file: Path, tmp_path: Path) -> None:
    status, out, error = run("cut", job_file, "--out", tmp_path / "out", *words)
    assert (status, out) == (2, "") and said in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()
