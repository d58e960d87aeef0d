"""What a cut found, in words and as plain values."""

from __future__ import annotations

import json

import pytest
from cut_samples import BOX, passes_over, plane, scene_of

from freecad_mpm.core import removal
from freecad_mpm.core.removal import CutReport
from freecad_mpm.core.removal.report import Place


@pytest.fixture(scope="module")
def cut() -> removal.Cut:
    return removal.cut(scene_of(plane(0.0)), passes_over(0.0, 4.0), 2.0, box=BOX, with_stock=False)


def test_words_and_json_tell_the_same(cut: removal.Cut) -> None:
    section = cut.section((0, 20, 0), (0, 1, 0), 0.5)
    told = CutReport.of(cut, {"middle": (section, section.deviation_mm)})
    plain = json.loads(told.to_json())
    assert plain["points"] == len(cut.deviation.points) and plain["volume_left_mm3"] is None
    assert plain["largest_remainder"]["deviation_mm"] == cut.deviation.deviation_mm.max()
    assert plain["worst_gouge"]["depth_mm"] == pytest.approx(0.0, abs=1e-6)
    assert plain["check_faces"] == {"points": 0, "deepest": None}
    assert plain["sections"]["middle"]["probed_max_mm"] == plain["sections"]["middle"]["max_mm"]
    text = told.text()
    assert f"Largest remainder: {plain['largest_remainder']['deviation_mm']:+.4f} mm" in text
    assert "Check faces: none is near" in text and "Section middle:" in text and "Stock left" not in text


def test_a_place_where_no_move_cut_says_so(cut: removal.Cut) -> None:
    nowhere = Place(1.0, [1.0, 2.0, 3.0], -1, None, {})
    assert nowhere.words() == "+1.0000 mm at 1.000 2.000 3.000, where no move cut"
    assert nowhere.to_dict() == {"deviation_mm": 1.0, "point": [1.0, 2.0, 3.0], "move": -1, "kind": None}


def test_a_programs_block_is_named(cut: removal.Cut) -> None:
    blocks = 10 * (1 + cut.deviation.move * 0)[: len(cut.path.kind)]
    told = CutReport.of(cut, block=blocks)
    assert told.largest_remainder.details["block"] == 10 and "block 10" in told.largest_remainder.words()
