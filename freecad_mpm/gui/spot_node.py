"""A mark in a 3D view."""

from __future__ import annotations

from typing import Any

from pivy import coin

from .toolpath_nodes import unlit, unpickable

COLOUR = (0.95, 0.0, 0.75)
SIZE = 12.0


class SpotNode:
    """A point that is drawn over everything else."""

    def __init__(self, view: Any) -> None:
        self._scene = view.getSceneGraph()
        material, style, depth = coin.SoMaterial(), coin.SoDrawStyle(), coin.SoDepthBuffer()
        material.diffuseColor, style.pointSize, depth.test = COLOUR, SIZE, False
        self._at, points = coin.SoCoordinate3(), coin.SoPointSet()
        points.numPoints = 1
        self.root = coin.SoSeparator()
        for node in (unpickable(), unlit(), material, style, depth, self._at, points):
            self.root.addChild(node)

    def show(self, point: Any) -> None:
        """At a point (3,), mm in FreeCAD's global frame; put into the view when it is not there yet."""
        self._at.point.setValue(*(float(value) for value in point))
        if self._scene.findChild(self.root) < 0:
            self._scene.addChild(self.root)

    def clear(self) -> None:
        """Calling it again changes nothing."""
        if self._scene.findChild(self.root) >= 0:
            self._scene.removeChild(self.root)
