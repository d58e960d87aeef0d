"""Verify in a document: the result's figures against the plan's own, its objects, and its picture, without a window."""

from __future__ import annotations

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import FreeCAD
import numpy as np
import pytest
from FreeCAD import Vector

from freecad_mpm.core.base import Cancelled, InputError
from freecad_mpm.document import cl_path, hooks, verification
from freecad_mpm.document.deviation import deviation_of

RESOLUTION_MM = 1.0


@pytest.fixture
def result(op: Any) -> Any:
    return verification.verify(op, RESOLUTION_MM)


def test_a_proven_path_leaves_no_gouge_and_some_remainder(op: Any, result: Any) -> None:
    # The path's cuts are proven within the chord tolerance; the removal knows nothing of that.
    assert -op.ChordTolerance.Value <= result.WorstGouge.Value <= 0.01
    assert result.Good and result.Tolerance == op.ChordTolerance
    assert 0.05 < result.WorstRemainder.Value < 15
    assert not result.Outdated
    assert sum(float(line.split(": ")[1].strip("< %")) for line in result.Bands) == pytest.approx(100, abs=1)


def test_the_stock_is_a_closed_mesh_that_holds_the_machined_block(op: Any, result: Any) -> None:
    mesh = result.Stock.Mesh
    assert mesh.isSolid()
    # The block below its faces to machine, its walls, and what remains: not less than the model cut to the mesh's base.
    base = FreeCAD.BoundBox(*mesh.BoundBox.getPoint(0), *mesh.BoundBox.getPoint(6)).ZMin
    model = op.Base[0][0].Shape
    below = model.cut(box_below(model.BoundBox, base)) if base > model.BoundBox.ZMin else model
    assert mesh.Volume > below.Volume - 0.02 * model.BoundBox.XLength * model.BoundBox.YLength


def box_below(bounds: Any, z: float) -> Any:
    import Part

    return Part.makeBox(
        bounds.XLength, bounds.YLength, z - bounds.ZMin, Vector(bounds.XMin, bounds.YMin, bounds.ZMin)
    )


def test_a_path_that_is_too_low_is_found_out_with_the_move_that_gouged(op: Any) -> None:
    """Half a millimetre lower all along, with every stored judgement left as good."""
    commands = op.Path.Commands
    for command in commands:
        if "Z" in command.Parameters:
            command.Parameters = {**command.Parameters, "Z": command.Parameters["Z"] - 0.5}
    import Path

    op.Path = Path.Path(commands)
    op.purgeTouched()
    result = verification.verify(op, RESOLUTION_MM)
    # The chord tolerance comes on top, and a tool surface that leans to the normal is met a little later along it.
    assert -0.53 < result.WorstGouge.Value < -0.4
    moves = cl_path.from_commands(op.Path.Commands)
    assert moves.kind[result.WorstGougeMove] in ("cut", "plunge")
    tip = moves.tip[result.WorstGougeMove]
    assert np.linalg.norm(tip - np.array(result.WorstGougePoint)) < 2 * 12.7
    # The walls under the borders of the top are not picked; they are cut as deep.
    assert -0.53 < result.WorstCheckGouge.Value < -0.4
    assert 0 <= result.WorstCheckGougeMove < len(moves.kind)
    assert moves.kind[result.WorstCheckGougeMove] in ("cut", "plunge")
    assert wall_distance(op, result.WorstCheckGougePoint) < 1e-6
    found = deviation_of(result)
    assert found.deviation_mm[found.measured :].min() == pytest.approx(result.WorstCheckGouge.Value, abs=1e-6)
    assert not result.Good
    assert any(line.startswith("below -0.1 mm") for line in result.Bands)


def wall_distance(op: Any, point: Any) -> float:
    """From the faces of the model that are not picked."""
    import Part

    model, picked = op.Base[0]
    walls = [face for i, face in enumerate(model.Shape.Faces, 1) if f"Face{i}" not in picked]
    return min(face.distToShape(Part.Vertex(point))[0] for face in walls)


def test_faces_that_are_not_picked_and_not_cut_are_told_so(op: Any, result: Any) -> None:
    assert -op.ChordTolerance.Value <= result.WorstCheckGouge.Value <= 0
    result = verification.verify(op, 4.0)
    found = deviation_of(result)
    assert (found.deviation_mm[found.measured :] >= -op.ChordTolerance.Value).all()


def test_the_memory_is_said_before_and_refused_with_what_would_fit(
    op: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from freecad_mpm.core.removal import memory

    lines = []
    with monkeypatch.context() as patch:
        patch.setattr(
            hooks, "run", lambda call: lines.append("started") or call(on_progress=None, cancel=None)
        )
        patch.setattr(verification.FreeCAD, "Console", SimpleNamespace(PrintMessage=lines.append))
        verification.verify(op, 2.0)
    assert "A cut at 2 mm takes about" in lines[0] and lines[1] == "started"
    monkeypatch.setattr(memory, "available", lambda: 5e6)
    with pytest.raises(InputError, match=r"Resolution: 0.05 mm takes .* may be used; [\d.]+ mm would fit"):
        verification.verify(op, 0.05)


def test_the_stored_deviation_holds_the_extremes(result: Any) -> None:
    found = deviation_of(result)
    assert found.deviation_mm[: found.measured].min() == pytest.approx(result.WorstGouge.Value, abs=1e-6)
    assert found.deviation_mm.max() == pytest.approx(result.WorstRemainder.Value, rel=1e-6)
    row = found.nearest(result.WorstRemainderPoint)
    assert found.deviation_mm[row] == pytest.approx(result.WorstRemainder.Value, rel=1e-6)
    assert found.move[row] == result.WorstRemainderMove
    assert found.triangles.max() < len(found.points)


def test_the_position_in_which_a_move_ends(op: Any) -> None:
    reached = [move for move, code in enumerate(op.MoveStatus) if code >= 0]
    between = next(move for move, code in enumerate(op.MoveStatus) if code < 0)
    assert verification.position_at(op, reached[5]) == 5
    assert [verification.position_at(op, move) for move in (between, -1, 10**6)] == [-1, -1, -1]


def test_verifying_again_fills_the_same_objects(op: Any, result: Any) -> None:
    objects = len(op.Document.Objects)
    assert verification.verify(op, 2 * RESOLUTION_MM) == result
    assert result.Resolution.Value == 2 * RESOLUTION_MM
    assert len(op.Document.Objects) == objects


def test_a_new_path_makes_it_outdated_and_reopening_does_not(op: Any, result: Any, tmp_path: Path) -> None:
    doc, file = op.Document, str(tmp_path / "part.FCStd")
    worst = result.WorstGouge.Value
    doc.saveAs(file)
    FreeCAD.closeDocument(doc.Name)
    doc = FreeCAD.openDocument(file)
    result = doc.getObject("Verification")
    assert isinstance(result.Proxy, verification.Verification)
    assert result.WorstGouge.Value == pytest.approx(worst)
    assert len(deviation_of(result).points) > 1000
    result.touch()
    doc.recompute()
    assert not result.Outdated
    result.Operation.ForwardStep = "12 mm"
    doc.recompute()
    assert result.Outdated


def test_cancel_changes_nothing(op: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hooks, "run", lambda call: call(on_progress=None, cancel=lambda: True))
    objects = len(op.Document.Objects)
    with pytest.raises(Cancelled):
        verification.verify(op, RESOLUTION_MM)
    assert len(op.Document.Objects) == objects


def test_progress_is_told(op: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    stages = []
    monkeypatch.setattr(
        hooks, "run", lambda call: call(on_progress=lambda stage, _: stages.append(stage), cancel=None)
    )
    verification.verify(op, RESOLUTION_MM)
    assert {"deviation", "stock"} <= set(stages)


def test_without_a_path_there_is_nothing_to_verify(op: Any) -> None:
    op.SideStep = 0
    op.Document.recompute()
    with pytest.raises(InputError, match="there is no up-to-date path"):
        verification.verify(op)


def test_the_picture(result: Any, tmp_path: Path) -> None:
    verification.write_picture(result, str(tmp_path / "deviation.png"))
    assert (tmp_path / "deviation.png").read_bytes().startswith(b"\x89PNG")
