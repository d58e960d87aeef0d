"""The command `picture`."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from command_line import run


def test_picture_draws_chosen_positions(job_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "pictures"
    status, text, error = run("picture", job_file, "--position", 1, 12, "--out", out)
    assert (status, error) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == ["position_000001.png", "position_000012.png"]
    assert all((out / name).read_bytes().startswith(b"\x89PNG") and name in text for name in os.listdir(out))


@pytest.mark.parametrize(
    ("number", "message"),
    [
        (0, "argument --position: must be a whole number from 1, got '0'"),
        (29, "position 29: must be from 1 to 28"),
    ],
)
def test_picture_of_a_position_that_is_not_there(
    job_file: Path, tmp_path: Path, number: int, message: str
) -> None:
    status, text, error = run("picture", job_file, "--position", number, "--out", tmp_path / "pictures")
    assert (status, text) == (2, "") and message in error and error.count("\n") == 1
    assert not (tmp_path / "pictures").exists()
