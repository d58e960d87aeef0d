"""Deviation colours on the machined faces, and their legend, as Coin nodes."""

from __future__ import annotations

from typing import Any

import numpy as np
from pivy import coin

from ..core.removal import Bands
from ..core.removal import bands as deviation_bands
from ..document.deviation import Deviation
from .toolpath_nodes import unlit, unpickable

# The legend, in a picture that reaches from -1 to 1 both ways: lower left corner, size of a patch, text beside it.
LEFT, BOTTOM, WIDTH, HEIGHT, GAP = -0.97, -0.93, 0.035, 0.055, 0.012
FONT_SIZE = 13
TEXT_COLOUR = (0.05, 0.05, 0.05)
PAPER_COLOUR, PAPER_WIDTH = (0.96, 0.96, 0.96), 0.36


class DeviationNodes:
    """`root` holds the coloured faces and the legend; `show` fills it."""

    def __init__(self) -> None:
        self._points, self._faces, self._material = (
            coin.SoCoordinate3(),
            coin.SoIndexedFaceSet(),
            coin.SoMaterial(),
        )
        binding, hints, offset = coin.SoMaterialBinding(), coin.SoShapeHints(), coin.SoPolygonOffset()
        binding.value = coin.SoMaterialBinding.PER_FACE_INDEXED
        hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE  # two-sided light
        offset.factor, offset.units = -1.0, -1.0  # before the part's own faces, which lie in the same place
        surface = coin.SoSeparator()
        for node in (hints, offset, self._material, binding, self._points, self._faces):
            surface.addChild(node)
        self._legend = coin.SoSeparator()
        self.root = coin.SoSeparator()
        self.root.addChild(unpickable())  # FreeCAD paints over what is selected
        self.root.addChild(surface)
        self.root.addChild(_outside_the_bounds(self._legend))

    @property
    def count(self) -> int:
        """Number of triangles drawn."""
        return int(self._faces.materialIndex.getNum()) if self._points.point.getNum() else 0

    def show(self, found: Deviation, bands: Bands) -> None:
        """Colour each triangle by its worst corner, a gouge before what remains."""
        band = bands.of(found.deviation_mm)[found.triangles].min(axis=1)
        index = np.column_stack((found.triangles, np.full(len(band), coin.SO_END_FACE_INDEX)))
        self._material.diffuseColor.setValues(0, len(deviation_bands.COLOURS), deviation_bands.COLOURS)
        _fill(self._points.point, found.points.tolist())
        _fill(self._faces.coordIndex, index.astype(np.int64).ravel().tolist())
        _fill(self._faces.materialIndex, band.tolist())
        self._legend.removeAllChildren()
        for node in _legend(bands):
            self._legend.addChild(node)


def _fill(field: Any, values: list[Any]) -> None:
    field.setNum(len(values))
    field.setValues(0, len(values), values)


def _outside_the_bounds(node: Any) -> Any:
    """FreeCAD's group that "fit all" does not look into."""
    group = coin.SoType.fromName("SoSkipBoundingGroup").createInstance()
    group.getField("mode").set("EXCLUDE_BBOX")
    group.addChild(node)
    return group


def _legend(bands: Bands) -> list[Any]:
    camera, depth, font = coin.SoOrthographicCamera(), coin.SoDepthBuffer(), coin.SoFont()
    camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
    camera.position, camera.height, camera.nearDistance, camera.farDistance = (0, 0, 1), 2.0, 0.5, 1.5
    depth.test = False
    font.size = FONT_SIZE
    nodes = [unlit(), camera, depth, font]
    step = HEIGHT + GAP
    count = len(bands.names)
    nodes.append(_patch(LEFT - GAP, BOTTOM - GAP, PAPER_WIDTH, count * step + GAP, PAPER_COLOUR))
    for row, (name, colour) in enumerate(zip(bands.names, deviation_bands.COLOURS)):
        bottom = BOTTOM + row * step
        nodes.append(_patch(LEFT, bottom, WIDTH, HEIGHT, colour))
        nodes.append(_text(LEFT + WIDTH + GAP, bottom + HEIGHT / 4, name))
    return nodes


def _patch(
    left: float, bottom: float, width: float, height: float, colour: tuple[float, float, float]
) -> Any:
    material, points, face, separator = (
        coin.SoMaterial(),
        coin.SoCoordinate3(),
        coin.SoFaceSet(),
        coin.SoSeparator(),
    )
    material.diffuseColor = colour
    right, top = left + width, bottom + height
    corners = [(left, bottom, 0), (right, bottom, 0), (right, top, 0), (left, top, 0)]
    points.point.setValues(0, len(corners), corners)
    for node in (material, points, face):
        separator.addChild(node)
    return separator


def _text(left: float, bottom: float, words: str) -> Any:
    material, place, text, separator = (
        coin.SoMaterial(),
        coin.SoTranslation(),
        coin.SoText2(),
        coin.SoSeparator(),
    )
    material.diffuseColor = TEXT_COLOUR
    place.translation = (left, bottom, 0)
    text.string = words
    for node in (material, place, text):
        separator.addChild(node)
    return separator
