"""The command `info`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from command_line import run


def test_info_lists_the_faces(thesis_part: Callable[[str], Path]) -> None:
    status, text, error = run("info", thesis_part("saddle"))
    assert (status, error) == (0, "")
    assert "Face1" in text and "150.000" in text
