"""The picture: drawn for good, bad and empty plans, and showing what it counts."""

import io
from types import SimpleNamespace

import matplotlib.image
import numpy as np
import pytest
from matplotlib.figure import Figure

from freecad_mpm import _core
from freecad_mpm.core.part import FaceArrays, quads
from freecad_mpm.core.pictures import plan as picture
from freecad_mpm.core.pictures import plan_panels

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
TOOL = _core.Tool(6.7, 6.0, 6.0, 40.0)
HOLE = np.array([[0.25, 0.25], [0.75, 0.25], [0.75, 0.75], [0.25, 0.75]])
BORDER = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def floor(name="Face1", trim_loops=()):
    poles = np.array([[[0, 0, 0], [0, 100, 0]], [[100, 0, 0], [100, 100, 0]]], dtype=float)
    return FaceArrays(name, "plane", 1, 1, KNOTS, KNOTS, poles, trim_loops=trim_loops)


def plan_on_floor(usable=True, flip=1.0):
    """Upright positions on the floor, one of them gouging; flip = -1: the part lies upside down."""
    points, passes = _core.raster([20, 20], [80, 80], direction_deg=90, side_step_mm=20, forward_step_mm=5)
    count = len(points)
    tip = np.column_stack([points, np.zeros(count)])
    axis = np.tile([0.0, 0.0, 1.0], (count, 1))
    face = floor()
    surface = _core.BSplineSurface(1, 1, KNOTS, KNOTS, face.poles)
    path = _core.link_passes(
        _core.CellTree(_core.SurfaceModel([_core.Face("Face1", surface)]), TOOL),
        TOOL,
        tip,
        axis,
        passes,
        np.full(count, usable),
        context=_core.Context(),
    )
    moves = SimpleNamespace(**path | {"kind": np.array(_core.MOVE_KINDS)[path["kind"]]})
    moves.axis = moves.axis * flip
    clearance = np.column_stack([np.full(count, -np.inf), np.full(count, 2e-4)])
    clearance[7, 1] = -0.004
    contacts = np.stack([tip + [6.7, 0, 0], tip - [6.7, 0, 0]], axis=1)
    contacts[3, 1] = np.nan
    status = np.where(np.arange(count) == 3, "tilt_limited", "two_contacts")
    positions = SimpleNamespace(
        tip=tip,
        axis=axis * flip,
        contacts=contacts,
        status=status,
        clearance=clearance,
        tilt_deg=np.linspace(0, 10, count),
        pass_index=passes,
    )
    return SimpleNamespace(**vars(positions), positions=positions, path=moves)


def pixels(png):
    return matplotlib.image.imread(io.BytesIO(png))


def share_of_colour(image, colour, within=0.1):
    return np.mean(np.abs(image[..., :3] - np.array(colour)).max(axis=-1) < within)


def test_size_and_passes():
    image = pixels(picture.render(plan_on_floor(), [floor()], title="floor"))
    assert image.shape[:2] == (picture.HEIGHT_PX, picture.WIDTH_PX)
    blue = (0x00 / 255, 0x72 / 255, 0xB2 / 255)
    assert share_of_colour(image[:, :1050], blue) > 0.001  # the passes, in the view in space


@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_a_blocked_move_is_red(flip):
    plan = plan_on_floor(flip=flip)
    plan.clearance[:, 1] = 0.0
    red = (0xD0 / 255, 0x1C / 255, 0x1C / 255)
    before = share_of_colour(pixels(picture.render(plan, [floor()]))[:, :1050], red)
    plan.path.blocked[5:9] = True
    assert share_of_colour(pixels(picture.render(plan, [floor()]))[:, :1050], red) > before


def test_key_counts():
    axes = Figure().add_subplot()
    plan_panels.key(axes, plan_on_floor(), 0.001)
    legends = [child for child in axes.get_children() if hasattr(child, "get_texts")]
    texts = [text.get_text() for legend in legends for text in legend.get_texts()]
    assert {"51  two contacts", "1  tilt limited", "52  first contact P", "51  second contact Q"} <= set(
        texts
    )
    assert {"1  deeper than 1 µm", "48  cut, by status", "4  plunge", "4  retract"} <= set(texts)


def test_no_usable_position_still_gives_a_picture():
    assert pixels(picture.render(plan_on_floor(usable=False), [floor()])).shape[2] == 4


def test_draw_writes_the_file(tmp_path):
    picture.draw(plan_on_floor(), [floor()], tmp_path / "path.png")
    assert (tmp_path / "path.png").read_bytes().startswith(b"\x89PNG")
    assert [file.name for file in tmp_path.iterdir()] == ["path.png"]


def test_trimmed_away_parts_are_not_drawn():
    whole, holed = quads([floor(), floor(trim_loops=(BORDER, HOLE))], 2 * 40 * 40)
    assert len(whole) == 40 * 40
    assert len(holed) == pytest.approx(0.75 * len(whole), rel=0.01)
