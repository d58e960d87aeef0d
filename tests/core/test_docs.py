"""What docs/ says of cl.csv is so."""

from __future__ import annotations

from pathlib import Path

from freecad_mpm.core.path import cl_file

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_documented_header_is_ours() -> None:
    assert cl_file.HEADER in (DOCS / "command-line.md").read_text()
