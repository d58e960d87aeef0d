"""Removal through its Python door: closed forms, independent sampling, progress and cancel."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from cut_samples import BALL_MM, BOX, moves, passes_over, plane, scene_of

from freecad_mpm import _core
from freecad_mpm.core import planning, removal
from freecad_mpm.core.base import Cancelled
from freecad_mpm.core.job import Job, Part, ToolSpec
from freecad_mpm.core.part import Frame, Scene
from freecad_mpm.core.removal import memory


@pytest.mark.parametrize("slope", [0.0, 0.5, -1.0])
def test_scallops_on_an_inclined_plane_have_their_closed_form(slope: float) -> None:
    side_step = 3.0
    step = side_step * np.hypot(slope, 1.0)
    scallop = BALL_MM - np.sqrt(BALL_MM**2 - step**2 / 4)
    errors = []
    for resolution in (2.0, 0.5, 0.2):
        cut = removal.cut(
            scene_of(plane(slope)), passes_over(slope, side_step), resolution, box=BOX, with_stock=False
        )
        values = cut.deviation.deviation_mm
        assert values.min() == pytest.approx(0.0, abs=2e-6 if resolution < 1 else scallop)
        # Between two samples the steepest flank falls by its slope: the largest sample comes near the cusp.
        errors.append(scallop - values.max())
        assert (
            -1e-6
            < errors[-1]
            < step / 2 / np.sqrt(BALL_MM**2 - step**2 / 4) * resolution * np.hypot(slope, 1)
        )
    assert errors[2] <= errors[0]
    section = cut.section((0, 21.3, 0), (0, 1, 0), 0.02)
    assert section.deviation_mm.max() == pytest.approx(scallop, rel=0.01)


def test_scallops_in_a_spherical_pocket_have_their_closed_form() -> None:
    """Passes x = 0, 2, ... of a ball in a bowl of radius 40: in the plane y = 0 the cusp between two lies on the
    bisector of the ball's centres, which lie on a circle of radius 40 - 5 round the bowl's centre."""
    bowl, step = 40.0, 2.0
    reach = bowl - BALL_MM
    rows = []
    for x in np.arange(-20.0, 21.0, step):
        radius = np.sqrt(reach**2 - x**2)
        for i, angle in enumerate(np.radians(np.arange(-20.0, 20.5, 0.5))):
            center = [x, radius * np.sin(angle), -radius * np.cos(angle)]
            rows.append(("rapid" if i == 0 else "cut", [center[0], center[1], center[2] - BALL_MM]))
    path = moves(rows)
    tool = _core.Tool(0.0, BALL_MM, 0.0, 30.0)
    sweep = _core.ToolSweep(tool, path.tip, path.axis, path.kind == "cut")
    # Bisectors of all neighbours, and the middle of one pass.
    first = np.arcsin(np.arange(-20.0, 19.0, step) / reach)
    second = np.arcsin(np.arange(-18.0, 21.0, step) / reach)
    lean, half = (first + second) / 2, (second - first) / 2
    lean, half = np.append(lean, 0.0), np.append(half, 0.0)
    normals = -np.column_stack([np.sin(lean), np.zeros(len(lean)), -np.cos(lean)])
    box = removal.Box(np.full(3, -bowl), np.array([bowl, bowl, 0.0]))
    height, _ = removal.cut_rays(sweep, -bowl * normals, normals, box, 5.0, _core.Context())
    cusp = reach * np.cos(half) + np.sqrt(BALL_MM**2 - (reach * np.sin(half)) ** 2)
    assert height == pytest.approx(bowl - cusp, abs=1e-6)
    assert height[10] > 0.005 and height[-1] == pytest.approx(0.0, abs=1e-6)


@pytest.fixture(scope="module")
def coarse(thesis_part: Callable[[str], Path]) -> tuple[planning.Plan, removal.Cut]:
    """A coarse vcrf plan of the saddle in a set-up that is not the part's frame."""
    from freecad_mpm.core.job import FootprintSpec, MethodSpec, Setup, Tolerance

    job = Job(
        part=Part(str(thesis_part("saddle"))),
        tool=ToolSpec(6.7, 6.0, recess_mm=6.0, flute_length_mm=40.0),
        setup=Setup(origin=(75.0, 75.0, 80.0), x=(0.0, 1.0, 0.0)),
        footprint=FootprintSpec(side_step_mm=30.0, forward_step_mm=10.0),
        method=MethodSpec("vcrf"),
        tolerance=Tolerance(gouge_mm=0.02, chord_mm=2.0),
    )
    plan = planning.plan(job)
    return plan, removal.cut(plan.scene, plan.path, 3.0)


def test_the_deviation_is_that_of_dense_sampling(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, cut = coarse
    found, path, tool = cut.deviation, plan.path, plan.scene.tool
    rng = np.random.default_rng(1)
    for i in rng.choice(np.flatnonzero(found.move >= 0), 25, replace=False):
        near = np.flatnonzero(
            (np.linalg.norm(path.tip - found.points[i], axis=1) < 40.0) & (path.kind != "rapid")
        )
        t = np.linspace(-1.0, 6.0, 1401)
        points = found.points[i] + t[:, None] * found.normals[i]
        cut_away = np.zeros(len(t), dtype=bool)
        for k in near[near > 0]:
            for share in np.linspace(0, 1, 41):
                axis = (1 - share) * path.axis[k - 1] + share * path.axis[k]
                tip = (1 - share) * path.tip[k - 1] + share * path.tip[k]
                cut_away |= tool.signed_distance(tip, axis / np.linalg.norm(axis), points) < 0
        first = t[np.argmax(cut_away)] if cut_away.any() else np.inf
        if first < 6.0:
            assert found.deviation_mm[i] == pytest.approx(first, abs=0.012)


def test_the_move_that_cut_is_near(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, cut = coarse
    found = cut.deviation
    cut_by = found.move >= 0
    ends = np.minimum(
        np.linalg.norm(plan.path.tip[found.move] - found.points, axis=1),
        np.linalg.norm(plan.path.tip[found.move - 1] - found.points, axis=1),
    )
    assert cut_by.mean() > 0.5 and ends[cut_by].max() < plan.scene.tool.radius + 12.0
    assert (plan.path.kind[found.move[cut_by]] != "rapid").all()


def test_worst_names_the_extremes(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    _, cut = coarse
    worst, values = cut.worst(), cut.deviation.deviation_mm
    assert (worst.gouge.deviation_mm, worst.remainder.deviation_mm) == (values.min(), values.max())
    again, move = cut.heights(worst.gouge.point[None], cut.deviation.normals[[np.argmin(values)]])
    assert (again[0], move[0]) == (pytest.approx(values.min(), abs=1e-9), worst.gouge.move)


def test_the_mesh_lies_where_the_deviation_says(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, cut = coarse
    mesh = cut.mesh()
    corners = mesh.vertices[mesh.triangles]
    volume = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    # Corners are chamfered over a cell.
    assert volume == pytest.approx(cut.dexels.volume_mm3, rel=0.03)
    lo, hi = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    assert lo[:2] == pytest.approx([0.0, 0.0]) and hi[:2] == pytest.approx([150.0, 150.0])
    assert hi[2] <= plan.scene.frame.origin[2] + cut.stock.hi[2] + 1e-9


def test_a_small_box_looks_closely(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, _ = coarse
    small = ([-2.0, -2.0, 8.0], [2.0, 2.0, 16.0])
    cut = removal.cut(plan.scene, plan.path, 0.05, box=small)
    setup = plan.scene.frame.to_setup(cut.deviation.points)
    assert (setup >= small[0]).all() and (setup <= small[1]).all() and 4000 < len(setup) < 12_000
    assert cut.dexels.counts == [80, 80, 160]
    with_stock, without = (memory.needed(plan.scene, 0.05, small, one) for one in (True, False))
    assert memory.MESH_TO_DEXELS * cut.dexels.bytes == pytest.approx(with_stock - without, rel=0.5)
    assert without == pytest.approx(memory.BYTES_A_POINT * len(setup), rel=0.3)


def test_progress_and_cancel(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, _ = coarse
    seen: list[tuple[str, float]] = []
    removal.cut(plan.scene, plan.path, 5.0, on_progress=lambda stage, share: seen.append((stage, share)))
    done = dict.fromkeys(stage for stage, share in seen if share == 1.0)
    assert list(done) == ["samples", "deviation", "stock"]
    stop = threading.Event()
    timer = threading.Timer(0.3, stop.set)
    timer.start()
    with pytest.raises(Cancelled):
        removal.cut(plan.scene, plan.path, 0.05, cancel=stop)


def test_the_result_does_not_depend_on_threads(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, _ = coarse
    one, two = (removal.cut(plan.scene, plan.path, 4.0, threads=n) for n in (1, 2))
    assert np.array_equal(one.deviation.deviation_mm, two.deviation.deviation_mm)
    assert np.array_equal(one.deviation.move, two.deviation.move)
    assert np.array_equal(one.mesh().vertices, two.mesh().vertices)


def test_errors_name_the_argument(coarse: tuple[planning.Plan, removal.Cut]) -> None:
    plan, _ = coarse
    with pytest.raises(ValueError, match="resolution_mm"):
        removal.cut(plan.scene, plan.path, 0.0)
    with pytest.raises(ValueError, match="box"):
        removal.cut(plan.scene, plan.path, 1.0, box=([500.0, 0, 0], [510.0, 1, 1]))
    with pytest.raises(ValueError, match="with_stock"):
        removal.cut(plan.scene, plan.path, 9.0, with_stock=False).mesh()


def test_gouges_are_found_where_they_are_made() -> None:
    """A ball that dips 0.03 mm into a plane in the middle of a pass."""
    rows = [("rapid", [20.0, -9.0, 0.0]), ("cut", [20.0, 15.0, 0.0]), ("cut", [20.0, 20.0, -0.03])]
    path = moves(rows + [("cut", [20.0, 25.0, 0.0]), ("cut", [20.0, 50.0, 0.0])])
    gouge = removal.cut(scene_of(plane(0.0)), path, 0.25, with_stock=False).worst().gouge
    assert gouge.deviation_mm == pytest.approx(-0.03, abs=1e-6)
    assert gouge.point == pytest.approx([20.0, 20.0, 0.0], abs=0.2) and gouge.move in (2, 3)


def test_frames_are_the_parts() -> None:
    frame = Frame(np.array([10.0, 0.0, 0.0]), np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    scene = scene_of(plane(0.0))
    turned = Scene(frame, scene.machined, scene.check, _turned_model(scene, frame), scene.tool)
    path = passes_over(0.0, 3.0)
    one, two = (removal.cut(s, path, 1.0, with_stock=False) for s in (scene, turned))
    assert two.deviation.points == pytest.approx(one.deviation.points, abs=1e-9)
    assert two.deviation.deviation_mm == pytest.approx(one.deviation.deviation_mm, abs=1e-6)


def _turned_model(scene: Scene, frame: Frame) -> object:
    from freecad_mpm.core.part import surface_model

    return surface_model(scene.machined, scene.check, frame)
