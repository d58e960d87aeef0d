"""What a document keeps: the operation, its path with the axes, its results; also without the native module."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np
import pytest

from freecad_mpm.document import cl_path, computation, properties
from freecad_mpm.document.operation import MultiPointFinish
from freecad_mpm.document.verification import Verification

ROOT = Path(__file__).resolve().parents[2]
# Where FreeCAD looks for add-ons: up to 1.0, and 1.1.
ADD_ON_FOLDERS = (".local/share/FreeCAD/Mod", ".local/share/FreeCAD/v1-1/Mod")


def reopen(op: Any, folder: Path) -> Any:
    doc, name, file = op.Document, op.Name, str(folder / "part.FCStd")
    doc.saveAs(file)
    FreeCAD.closeDocument(doc.Name)
    return FreeCAD.openDocument(file).getObject(name)


def test_reopening_keeps_moves_and_axes_without_computing(
    op: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = cl_path.from_commands(op.Path.Commands)
    monkeypatch.setattr(computation, "compute", lambda *_: pytest.fail("computed again"))
    after = cl_path.from_commands(reopen(op, tmp_path).Path.Commands)
    assert after.kind == before.kind
    for name in ("pass_index", "tip", "axis", "feed_mm_per_min"):
        assert (getattr(after, name) == getattr(before, name)).all(), name


def test_reopening_keeps_every_property(op: Any, tmp_path: Path) -> None:
    op.Spin, op.ZigZag, op.Margin = "10 deg", True, "-1 mm"
    before = {one.name: getattr(op, one.name) for one in properties.PROPERTIES}
    after = reopen(op, tmp_path)
    assert isinstance(after.Proxy, MultiPointFinish)
    for name, value in before.items():
        assert getattr(after, name) == value, name


def test_a_reopened_operation_computes_the_same_again(op: Any, tmp_path: Path) -> None:
    before = cl_path.from_commands(op.Path.Commands)
    after = reopen(op, tmp_path)
    after.touch()
    after.Document.recompute()
    assert after.Problem == ""
    moves = cl_path.from_commands(after.Path.Commands)
    assert moves.kind == before.kind
    assert (moves.tip == before.tip).all() and (moves.axis == before.axis).all()


def test_results_are_read_only_and_stored_data_hidden(op: Any, tmp_path: Path) -> None:
    after = reopen(op, tmp_path)
    assert "ReadOnly" in after.getEditorMode("Report")
    assert "Hidden" in after.getEditorMode("MoveStatus")


def test_an_older_document_gains_the_new_properties(op: Any, tmp_path: Path) -> None:
    op.removeProperty("SafeClearance")
    after = reopen(op, tmp_path)
    assert after.SafeClearance.Value == 5


WITHOUT_NATIVE = """
import os
import sys
import FreeCAD
sys.modules["freecad_mpm._core"] = None  # as if it had not been built
doc = FreeCAD.openDocument({file!r})
op = doc.getObject({name!r})
from freecad_mpm.document import cl_path
print("MOVES", len(cl_path.from_commands(op.Path.Commands)), op.State)
op.touch()
doc.recompute()
print("PROBLEM", op.Problem)
print("MOVES", len(cl_path.from_commands(op.Path.Commands)))
import freecad_mpm
try:
    freecad_mpm.create(doc, [(op.Base[0][0], "Face1")])
except Exception as error:
    print("CREATE", error)
sys.stdout.flush()
os._exit(0)
"""


def run_with_the_add_on_installed(script: Path, home: Path) -> str:
    """Output of a new FreeCAD that runs `script`; a new one restores operations of installed add-ons only."""
    for folder in ADD_ON_FOLDERS:
        (home / folder).mkdir(parents=True)
        (home / folder / "MultiPointMachining").symlink_to(ROOT)
    command = shutil.which("freecadcmd") or shutil.which("FreeCADCmd")
    assert command, "FreeCAD is missing"
    environment = {"HOME": str(home), "PATH": os.environ["PATH"], "LC_ALL": "C.UTF-8"}
    done = subprocess.run(
        [command, str(script)],
        env=environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=600,  # only what will never end takes so long, on a loaded machine too
    )
    return done.stdout + done.stderr


def test_without_the_native_module_the_document_opens_and_shows_its_path(op: Any, tmp_path: Path) -> None:
    moves, file = len(cl_path.from_commands(op.Path.Commands)), tmp_path / "part.FCStd"
    op.Document.saveAs(str(file))
    script = tmp_path / "open.py"
    script.write_text(WITHOUT_NATIVE.format(file=str(file), name=op.Name))
    output = run_with_the_add_on_installed(script, tmp_path / "home")
    assert f"MOVES {moves} ['Up-to-date']" in output, output
    problem = output.partition("PROBLEM ")[2]
    assert problem.startswith("the native module cannot be loaded") and "./dev build" in problem, output
    assert f"MOVES {moves}\n" in problem
    assert "CREATE the native module cannot be loaded" in problem


def test_a_document_from_before_the_rooms_of_core_opens_and_computes_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Saved by the version whose core was one flat folder (commit 6907d12), with an operation and its verification."""
    file = shutil.copy(ROOT / "tests/data/rooms_before.FCStd", tmp_path)
    with monkeypatch.context() as opening:
        opening.setattr(computation, "compute", lambda *_: pytest.fail("computed again"))
        doc = FreeCAD.openDocument(str(file))
    op, result = doc.getObject("MultiPointFinish"), doc.getObject("Verification")
    assert isinstance(op.Proxy, MultiPointFinish) and isinstance(result.Proxy, Verification)
    assert op.Good and op.SideStep.Value == 16.0 and op.Margin.Value == -2.0 and op.TiltMax.Value == 30.0
    before, report = cl_path.from_commands(op.Path.Commands), op.Verdict
    op.touch()
    doc.recompute()
    after = cl_path.from_commands(op.Path.Commands)
    assert (op.Problem, op.Verdict, after.kind) == ("", report, before.kind)
    assert np.allclose(after.tip, before.tip, atol=1e-6) and np.allclose(after.axis, before.axis, atol=1e-8)
    FreeCAD.closeDocument(doc.Name)
