"""The tool path as Coin nodes: moves by kind and status, tool axes, contact points."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from typing import Any

import numpy as np
from pivy import coin

Color = tuple[float, float, float]

CUT = "cut"
CUT_COLORS: dict[str, Color] = {
    "two_contacts": (0.05, 0.55, 0.20),
    "curvature_matched": (0.00, 0.60, 0.55),
    "one_contact": (0.85, 0.60, 0.00),
    "edge_contact": (0.85, 0.60, 0.00),
    "tilt_limited": (0.90, 0.40, 0.00),
    "bridged": (0.80, 0.10, 0.10),
}
LINK_COLORS: dict[str, Color] = {
    "rapid": (0.75, 0.20, 0.60),
    "plunge": (0.20, 0.35, 0.85),
    "retract": (0.20, 0.35, 0.85),
    "link": (0.20, 0.35, 0.85),
}
UNKNOWN_COLOR: Color = (0.45, 0.45, 0.45)
AXIS_COLOR: Color = (0.30, 0.50, 0.75)
FIRST_CONTACT_COLOR: Color = (0.85, 0.10, 0.10)
SECOND_CONTACT_COLOR: Color = (0.10, 0.20, 0.90)

CUT_WIDTH, LINK_WIDTH, AXIS_WIDTH = 3.0, 1.5, 1.0
CONTACT_SIZE = 4.0
# Drawn axes are this part of the path's size long; of many, every n-th is drawn.
AXIS_LENGTH = 0.06
AXES_MAX = 4000


class ToolpathNodes:
    """`root` holds everything; `show` fills it. Nothing in it can be picked, so that faces under it can."""

    def __init__(self) -> None:
        self.cuts = Lines(CUT_WIDTH)
        self.links = Lines(LINK_WIDTH)
        self.axes = Lines(AXIS_WIDTH)
        self.first = _Points(FIRST_CONTACT_COLOR)
        self.second = _Points(SECOND_CONTACT_COLOR)
        self.root = coin.SoSeparator()
        self.root.addChild(unpickable())
        self.root.addChild(unlit())
        for root in (self.links.root, self.axes.root, self.cuts.root, self.first.root, self.second.root):
            self.root.addChild(root)

    def show(self, moves: Any, statuses: Sequence[str], first: Sequence[Any], second: Sequence[Any]) -> None:
        """Draw `moves` (cl_path.StoredMoves), the status of each ("" for none), and the contact points."""
        self.cuts.set(*_strips(moves, [_color(k, s) for k, s in zip(moves.kind, statuses)], cuts=True))
        self.links.set(*_strips(moves, [_color(k, s) for k, s in zip(moves.kind, statuses)], cuts=False))
        self.axes.set(*_axes(moves))
        self.first.set(first)
        self.second.set(second)


class Lines:
    """Polylines with a colour per vertex."""

    def __init__(self, width: float) -> None:
        self._points, self._colors, self._line = coin.SoCoordinate3(), coin.SoMaterial(), coin.SoLineSet()
        binding, style = coin.SoMaterialBinding(), coin.SoDrawStyle()
        binding.value = coin.SoMaterialBinding.PER_VERTEX
        style.lineWidth = width
        self.root = _group(style, self._colors, binding, self._points, self._line)

    @property
    def count(self) -> int:
        """Number of points drawn."""
        return int(self._points.point.getNum())

    def set(self, points: list[list[float]], colors: list[Color], lengths: list[int]) -> None:
        """`lengths`: the number of points of each polyline."""
        _fill(self._points.point, points)
        _fill(self._colors.diffuseColor, colors)
        _fill(self._line.numVertices, lengths)


class _Points:
    def __init__(self, color: Color) -> None:
        self._points, self._set = coin.SoCoordinate3(), coin.SoPointSet()
        style, material = coin.SoDrawStyle(), coin.SoMaterial()
        style.pointSize = CONTACT_SIZE
        material.diffuseColor = color
        self.root = _group(style, material, self._points, self._set)

    @property
    def count(self) -> int:
        return int(self._points.point.getNum())

    def set(self, points: Sequence[Any]) -> None:
        _fill(self._points.point, [list(point) for point in points])
        self._set.numPoints = len(points)


def _color(kind: str, status: str) -> Color:
    table = CUT_COLORS if status in CUT_COLORS and kind == CUT else LINK_COLORS
    return table.get(status if table is CUT_COLORS else kind, UNKNOWN_COLOR)


def _strips(moves: Any, colors: list[Color], cuts: bool) -> tuple[list[Any], list[Color], list[int]]:
    """The polylines of the cuts, or of all other moves; each begins where the move before it ends."""
    points: list[Any] = []
    shown: list[Color] = []
    lengths: list[int] = []
    tips = moves.tip.tolist()
    for is_cut, alike in groupby(range(1, len(moves)), key=lambda move: moves.kind[move] == CUT):
        if is_cut == cuts:
            run = list(alike)
            points += tips[run[0] - 1 : run[-1] + 1]
            shown += [colors[run[0]], *(colors[move] for move in run)]
            lengths.append(len(run) + 1)
    return points, shown, lengths


def _axes(moves: Any) -> tuple[list[Any], list[Color], list[int]]:
    """A short line along the tool axis at every cut, or at every n-th when there are many."""
    cuts = np.array([move for move, kind in enumerate(moves.kind) if kind == CUT], dtype=int)
    cuts = cuts[:: len(cuts) // AXES_MAX + 1]
    if not len(cuts):
        return [], [], []
    length = AXIS_LENGTH * float(np.ptp(moves.tip[cuts], axis=0).max())
    ends = np.stack((moves.tip[cuts], moves.tip[cuts] + length * moves.axis[cuts]), axis=1)
    return ends.reshape(-1, 3).tolist(), [AXIS_COLOR] * (2 * len(cuts)), [2] * len(cuts)


def _fill(field: Any, values: list[Any]) -> None:
    field.setNum(len(values))  # setValues alone would leave the rest of a longer field
    if values:
        field.setValues(0, len(values), values)


def _group(*nodes: Any) -> Any:
    separator = coin.SoSeparator()
    for node in nodes:
        separator.addChild(node)
    return separator


def unpickable() -> Any:
    """Clicks go through what follows it, to the faces behind."""
    node = coin.SoPickStyle()
    node.style = coin.SoPickStyle.UNPICKABLE
    return node


def unlit() -> Any:
    """Lines have no normals: lit, they would be black."""
    node = coin.SoLightModel()
    node.model = coin.SoLightModel.BASE_COLOR
    return node
