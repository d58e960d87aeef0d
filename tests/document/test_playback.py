"""Playback of an operation in a document: from its stored path alone, and as pictures without a window."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD
import numpy as np
import pytest

from freecad_mpm.core.base import InputError
from freecad_mpm.document import cl_path, computation, playback


def test_it_meets_every_position_of_the_stored_path(op: Any) -> None:
    shown = playback.played(op)
    moves = cl_path.from_commands(op.Path.Commands)
    assert len(shown.playback.visited.move) == op.Positions
    for number in range(op.Positions):
        moment = shown.playback.moment(shown.playback.at_position(number))
        assert moment.tip == pytest.approx(moves.tip[moment.move], abs=1e-9)
        assert moment.axis == pytest.approx(moves.axis[moment.move], abs=1e-6)


def test_statuses_and_clearances_are_those_of_the_plan(op: Any) -> None:
    visited = playback.played(op).playback.visited
    names, counts = np.unique(visited.status, return_counts=True)
    assert {f"{name}: {count}" for name, count in zip(names, counts)} == set(op.Statuses)
    assert visited.clearance_mm.min() == pytest.approx(op.WorstClearance.Value, abs=1e-9)


def test_a_reopened_document_plays_without_computing(
    op: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = playback.played(op).playback
    doc, name, file = op.Document, op.Name, str(tmp_path / "part.FCStd")
    doc.saveAs(file)
    FreeCAD.closeDocument(doc.Name)
    monkeypatch.setattr(computation, "compute", lambda *_: pytest.fail("computed again"))
    after = playback.played(FreeCAD.openDocument(file).getObject(name)).playback
    assert (after.blocks.rotary_deg == before.blocks.rotary_deg).all()
    assert (after.visited.clearance_mm == before.visited.clearance_mm).all()
    assert after.seconds[-1] == before.seconds[-1]


def test_clearances_of_an_older_document_are_unknown(op: Any) -> None:
    op.PositionClearance = []
    assert np.isnan(playback.visited(op).clearance_mm).all()


def test_a_picture_of_a_chosen_position(op: Any, tmp_path: Path) -> None:
    paths = playback.write_pictures(op, [7], str(tmp_path))
    assert [Path(path).name for path in paths] == ["position_000007.png"]
    assert Path(paths[0]).read_bytes().startswith(b"\x89PNG")


def test_a_position_that_is_not_there(op: Any, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=rf"^position 999: must be from 1 to {op.Positions}$"):
        playback.write_pictures(op, [1, 999], str(tmp_path))
    assert not list(tmp_path.iterdir())


def test_without_a_path_there_is_nothing_to_play(op: Any) -> None:
    op.SideStep = 0
    op.Document.recompute()
    with pytest.raises(InputError, match="there is no up-to-date path"):
        playback.played(op)
