"""Faces that are not machined: a bad path's cuts into them are found, with place and move; memory is said beforehand."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from command_line import run
from cut_samples import moves, plane

from freecad_mpm.core import removal
from freecad_mpm.core.job import Job, Part, ToolSpec
from freecad_mpm.core.part import FaceArrays, Scene, build_scene
from freecad_mpm.core.removal import memory

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
FLOOR = plane(0.0)
RADIUS_MM = 5.0


def wall(x: float) -> FaceArrays:
    """Upright at x, along y, 10 mm high, over the floor z = 0."""
    poles = np.array([[[x, y, z] for z in (0.0, 10.0)] for y in (0.0, 40.0)])
    return FaceArrays("Face2", "plane", 1, 1, KNOTS, KNOTS, poles)


def walled(x: float) -> Scene:
    """The floor is machined, the wall kept clear of."""
    job = Job(part=Part("none", faces=("Face1",)), tool=ToolSpec(3.0, 2.0, flute_length_mm=30.0))
    return build_scene(job, [FLOOR, wall(x)])


def along_the_wall(nearest: float) -> SimpleNamespace:
    """Along y at x = 35, once as near as `nearest` to x = 40."""
    rows = [("rapid", [35.0, -10.0, 0.0]), ("cut", [35.0, 10.0, 0.0]), ("cut", [40.0 - nearest, 20.0, 0.0])]
    return moves([*rows, ("cut", [35.0, 30.0, 0.0]), ("cut", [35.0, 50.0, 0.0])])


@pytest.mark.parametrize("depth", [0.003, 0.2, 1.5])
def test_a_cut_into_the_neighbour_face_is_found(depth: float) -> None:
    cut = removal.cut(walled(40.0), along_the_wall(RADIUS_MM - depth), 0.25, with_stock=False)
    found = cut.worst().check
    assert found is not None
    assert found.deviation_mm == pytest.approx(-depth, abs=2e-6)
    assert found.point[:2] == pytest.approx([40.0, 20.0], abs=0.13) and found.point[2] >= 2
    assert found.move in (2, 3)
    assert cut.worst().gouge.deviation_mm == pytest.approx(0.0, abs=1e-6)  # the floor is as it should be
    assert cut.good(1.01 * depth) and not cut.good(0.99 * depth)
    assert cut.overcut.looked_at > 3000 and len(cut.overcut.points) < cut.overcut.looked_at
    assert (cut.overcut.depth_mm[cut.overcut.triangles].max(axis=1) > 0).all()


def test_a_path_that_keeps_clear_cuts_none() -> None:
    cut = removal.cut(walled(40.0), along_the_wall(RADIUS_MM + 0.001), 0.25, with_stock=False)
    assert cut.worst().check is None and cut.good(0.0)
    assert cut.overcut.looked_at > 3000 and len(cut.overcut.points) == 0


def test_which_way_the_face_is_turned_does_not_matter() -> None:
    scene = walled(40.0)
    turned = [FLOOR, FaceArrays("Face2", "plane", 1, 1, KNOTS, KNOTS, wall(40.0).poles[::-1])]
    other = build_scene(Job(part=Part("none", faces=("Face1",)), tool=ToolSpec(3.0, 2.0)), turned)
    one, two = (
        removal.cut(s, along_the_wall(4.5), 0.5, with_stock=False).worst().check for s in (scene, other)
    )
    assert one and two and one.deviation_mm == pytest.approx(two.deviation_mm, abs=1e-9)


def test_a_box_leaves_out_what_is_cut_elsewhere() -> None:
    box = ([30.0, 0.0, -1.0], [41.0, 10.0, 10.0])
    cut = removal.cut(walled(40.0), along_the_wall(4.5), 0.25, box=box, with_stock=False)
    found = cut.worst().check
    assert found is None or found.point[1] <= 10.0


def test_near_an_edge_the_depth_is_the_tools_not_that_along_a_normal() -> None:
    """The tool dips 10 um into the floor over the edge of a wall that leads down: along its normal it is 0.3 mm."""
    poles = np.array([[[40.0, y, z] for z in (-10.0, 0.0)] for y in (0.0, 40.0)])
    down = FaceArrays("Face2", "plane", 1, 1, KNOTS, KNOTS, poles)
    job = Job(part=Part("none", faces=("Face1",)), tool=ToolSpec(3.0, 2.0, flute_length_mm=30.0))
    path = moves([("rapid", [38.0, -10.0, -0.01]), ("cut", [38.0, 50.0, -0.01])])
    cut = removal.cut(build_scene(job, [FLOOR, down]), path, 0.5, with_stock=False)
    found = cut.worst().check
    assert found is not None and found.deviation_mm == pytest.approx(-0.01, abs=1e-6)
    assert cut.good(0.0101) and not cut.good(0.0099)


def test_the_machined_face_is_judged_by_the_same_depth() -> None:
    path = moves([("rapid", [20.0, -9.0, 0.0]), ("cut", [20.0, 20.0, -0.03]), ("cut", [20.0, 50.0, 0.0])])
    cut = removal.cut(walled(60.0), path, 0.5, with_stock=False)
    assert cut.worst().gouge.deviation_mm == pytest.approx(-0.03, abs=1e-3)
    assert cut.good(0.031) and not cut.good(0.025)


def test_the_command_names_face_place_and_line_of_a_foreign_path(tmp_path: Path) -> None:
    from freecad_mpm import _occt

    faces = [
        {"degree_u": 1, "degree_v": 1, "knots_u": KNOTS, "knots_v": KNOTS, "poles": one.poles}
        for one in (FLOOR, wall(40.0))
    ]
    _occt.write_step(str(tmp_path / "corner.step"), faces, "corner")
    (tmp_path / "job.toml").write_text(
        '[part]\nfile = "corner.step"\nfaces = ["Face1"]\n[tool]\nmajor_radius_mm = 3\nminor_radius_mm = 2\n'
    )
    path = along_the_wall(4.5)
    rows = [f"{kind},{x},{y},{z},0,0,1" for kind, (x, y, z) in zip(path.kind, path.tip.tolist())]
    text = "\n".join(["kind,tip_x,tip_y,tip_z,axis_x,axis_y,axis_z", *rows]) + "\n"
    (tmp_path / "foreign.csv").write_text(text)
    out = tmp_path / "out"
    status, told, error = run("cut", tmp_path / "job.toml", tmp_path / "foreign.csv", "--out", out)
    assert (status, error) == (1, "")
    assert told.startswith("A cut at 0.5 mm takes about ")
    assert "Check faces: deepest in Face2, -0.5000 mm at 40.000 20.000" in told and "line 4" in told
    deepest = json.loads((out / "cut.json").read_text())["check_faces"]["deepest"]
    assert deepest["face"] == "Face2" and deepest["deviation_mm"] == pytest.approx(-0.5, abs=1e-3)


def test_what_takes_more_memory_than_there_is_says_what_would_fit(
    monkeypatch: pytest.MonkeyPatch, thesis_part: Callable[[str], Path]
) -> None:
    scene = walled(40.0)
    monkeypatch.setattr(memory, "available", lambda: 50e6)
    with pytest.raises(
        ValueError, match=r"0\.01 mm takes .* GB, and at most 50 MB may be used; ([\d.]+) mm"
    ) as told:
        memory.check(scene, 0.01)
    fits = float(str(told.value).split("; ")[1].split()[0])
    assert memory.needed(scene, fits) <= 50e6 < memory.needed(scene, 0.9 * fits)
    assert "takes about" in memory.check(scene, fits)
    with pytest.raises(ValueError, match=r"0\.0001 mm .*more than .* dexels; .* would fit"):
        memory.check(scene, 1e-4)
    assert "mm takes about" in memory.check(scene, 0.05, ([0, 0, -1], [5, 5, 1]))
