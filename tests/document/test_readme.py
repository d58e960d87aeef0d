"""The README's example of use from a script in FreeCAD runs as it is printed."""

from __future__ import annotations

import re
from pathlib import Path

import FreeCAD
import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_the_example_for_freecad_runs(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    examples = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    monkeypatch.chdir(ROOT)
    names: dict[str, object] = {}
    exec(compile(next(one for one in examples if "freecad_mpm.create" in one), "README.md", "exec"), names)
    operation = names["operation"]
    assert operation.Positions == 776  # type: ignore[attr-defined]
    assert "776 positions" in capsys.readouterr().out
    FreeCAD.closeDocument(operation.Document.Name)  # type: ignore[attr-defined]
