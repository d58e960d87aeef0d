"""Files appear whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from freecad_mpm.core.base import InputError, output


def test_files_are_written_and_nothing_else(tmp_path: Path) -> None:
    folder = tmp_path / "new" / "out"
    written = output.write_together(folder, {"a.txt": "ä", "b.bin": b"\x00"})
    assert written == [folder / "a.txt", folder / "b.bin"]
    assert sorted(path.name for path in folder.iterdir()) == ["a.txt", "b.bin"]
    assert (folder / "a.txt").read_text(encoding="utf-8") == "ä"


def test_after_a_failure_the_old_files_stand_and_no_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    output.write_together(tmp_path, {"a.txt": "old", "b.txt": "old"})

    def full(*arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    with pytest.raises(InputError, match=r"cannot be written: No space left"):
        output.write_together(tmp_path, {"a.txt": "new", "b.txt": "new"})
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"a.txt": "old", "b.txt": "old"}


def test_a_file_keeps_the_usual_permissions(tmp_path: Path) -> None:
    (tmp_path / "plain").write_text("")
    output.write_atomically(tmp_path / "ours", "")
    assert (tmp_path / "ours").stat().st_mode == (tmp_path / "plain").stat().st_mode


def test_a_file_in_place_of_the_folder_is_found_before_any_work(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for folder in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(InputError, match="must be a folder"):
            output.check_folder(folder)
    output.check_folder(tmp_path / "not" / "yet" / "there")
    assert not (tmp_path / "not").exists()
