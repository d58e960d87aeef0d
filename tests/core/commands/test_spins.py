"""The command `spins`."""

from __future__ import annotations

import csv
from pathlib import Path

from command_line import run


def test_spins_writes_the_spread_and_the_control(job_file: Path, tmp_path: Path) -> None:
    wanted = 'name = "exact"\ncontact_spacing_mm = 6\nspacing_measure = "direct"'
    job_file.write_text(job_file.read_text().replace('name = "vcrf"', wanted))
    status, text, error = run(
        "spins", job_file, "--out", tmp_path, "--at", "40,60", "110,90", "--step-deg", 30
    )
    assert (status, error) == (0, "")
    assert "Contacts 6 mm apart from contact to contact: within 1% at 28 of 28 positions" in text
    rows = list(csv.DictReader((tmp_path / "spins.csv").read_text().splitlines()))
    assert len(rows) == 24 and {row["status"] for row in rows} == {"two_contacts"}
    assert (tmp_path / "spins.png").exists() and (tmp_path / "spacing.png").exists()


def test_spins_beside_the_part_are_told_and_nothing_is_written(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("vcrf", "exact"))
    status, text, error = run(
        "spins", job_file, "--out", tmp_path / "out", "--at", "75,75", "400,20", "--step-deg", 90
    )
    assert (status, text) == (2, "") and not (tmp_path / "out").exists()
    assert error == "(400, 20): lies beside the part: no spin of the tool touches it there\n"
