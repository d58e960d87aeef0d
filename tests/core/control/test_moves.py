"""A program's text cut into the stock: the same deviation as its path, whatever the post."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from freecad_mpm.core import machine, planning, posts, removal
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control import kinematics, read_program
from freecad_mpm.core.job import FootprintSpec, Job, MethodSpec, Part, PostSpec, Tolerance, ToolSpec


@pytest.fixture(scope="module")
def plans(
    thesis_part: Callable[[str], Path], tmp_path_factory: pytest.TempPathFactory
) -> Callable[[str], SimpleNamespace]:
    """Post -> a coarse plan with it, and its program's file."""
    folder = tmp_path_factory.mktemp("programs")

    def make(post: str) -> SimpleNamespace:
        job = Job(
            part=Part(str(thesis_part("saddle"))),
            tool=ToolSpec(6.7, 6.0, recess_mm=6.0, flute_length_mm=40.0),
            footprint=FootprintSpec(side_step_mm=50.0, forward_step_mm=25.0),
            method=MethodSpec("vcrf"),
            tolerance=Tolerance(gouge_mm=0.02, chord_mm=0.02),
        )
        plan = planning.plan(replace(job, post=PostSpec(post)))
        path = folder / f"{post}{plan.program.file_name}"
        path.write_bytes(plan.program.text.encode("latin-1"))
        return SimpleNamespace(plan=plan, file=str(path))

    return make


@pytest.mark.parametrize("post", posts.names())
def test_a_program_cuts_what_its_path_cuts(post: str, plans: Callable[[str], SimpleNamespace]) -> None:
    made = plans(post)
    moves = read_program(made.file, "dmu80p")
    scene = made.plan.scene
    path, text = (removal.cut(scene, one, 3.0, with_stock=False) for one in (made.plan.path, moves))
    difference = text.deviation.deviation_mm - path.deviation.deviation_mm
    # Words have three decimals at worst, and the rotary axes leave the great circle by the chord tolerance; where a ray
    # passes beside the tool's side a little more makes a large difference.
    assert np.median(np.abs(difference)) < 5e-4 and np.percentile(np.abs(difference), 99) < 0.02
    assert np.mean((text.deviation.move >= 0) != (path.deviation.move >= 0)) < 0.005


def test_rotary_axes_turn_evenly_between_blocks(plans: Callable[[str], SimpleNamespace]) -> None:
    """Between two rows of a block the tool's direction is that of evenly blended angles."""
    moves = read_program(plans("dmu80p").file, "dmu80p")
    same = moves.block[1:] == moves.block[:-1]
    assert same.any()
    turn = kinematics.angles_between_deg(moves.axis[1:], moves.axis[:-1])
    assert turn[same].max() < 0.5
    way = np.linalg.norm(np.diff(moves.tip, axis=0), axis=1)
    inside = same[1:] & same[:-1] & (way[1:] > 1e-6)
    assert way[1:][inside] == pytest.approx(way[:-1][inside], rel=1e-6)


def test_what_cannot_be_read_is_one_line(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="nowhere.I: cannot be read"):
        read_program(str(tmp_path / "nowhere.I"), "dmu80p")
    empty = tmp_path / "empty.I"
    empty.write_text("%MPM01 G71 *\r\nN10 M5 *\r\nN99999 %MPM01 G71 *\r\n")
    with pytest.raises(InputError, match="found none"):
        read_program(str(empty), machine.load("dmu80p").name)
