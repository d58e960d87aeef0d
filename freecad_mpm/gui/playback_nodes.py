"""Tool and machine as Coin nodes: built once, then only the matrices before them change."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from pivy import coin

from ..core.base import Floats
from ..core.playback import PART, TOOL, TOOL_COLOURS, Mesh, colour_of, sketch, table_letters, tool_solid
from ..document.playback import Played
from .toolpath_nodes import CUT_COLORS, Lines, unlit, unpickable

# Of a path of more moves than this a thinned line is drawn instead, so that every frame stays quick.
LONG_PATH = 20_000
TRAIL_POINTS = 5_000
TRAIL_WIDTH = 1.5
# Faces that meet at less than this look round; radians.
CREASE_ANGLE = 0.6


class PlaybackNodes:
    """`root` holds tool and machine, `part` the matrix that carries the document's objects in the machine's view."""

    def __init__(self, played: Played) -> None:
        self.root, self.part = coin.SoSeparator(), coin.SoMatrixTransform()
        self.root.addChild(unpickable())
        self._matrices: dict[str, Any] = {}
        self._add(TOOL, _tool(played), self.root)
        self._machine = coin.SoSwitch()
        self.root.addChild(self._machine)
        tables = table_letters(played.playback.machine)
        meshes = sketch.sketch(played.playback.machine, played.part_box, played.tool)
        for name, mesh in meshes.items():
            self._add(name, [_shape(mesh, colour_of(name, tables))], self._machine)

    def show_machine(self, shown: bool) -> None:
        """The sketch of the machine alone; the tool is always shown."""
        self._machine.whichChild = coin.SO_SWITCH_ALL if shown else coin.SO_SWITCH_NONE

    def place(self, bodies: Mapping[str, Floats]) -> None:
        """Move everything; `bodies` as core.playback.Playback.body_matrices gives them."""
        for name, node in self._matrices.items():
            node.matrix = _coin_matrix(bodies[name])
        self.part.matrix = _coin_matrix(bodies[PART])

    def _add(self, name: str, shapes: list[Any], parent: Any) -> None:
        separator, matrix = coin.SoSeparator(), coin.SoMatrixTransform()
        for node in (matrix, *shapes):
            separator.addChild(node)
        parent.addChild(separator)
        self._matrices[name] = matrix


class Stage:
    """The nodes in a 3D view, before the document's objects, so that `part` carries those."""

    def __init__(self, view: Any, op: Any, played: Played, nodes: PlaybackNodes) -> None:
        self._nodes = [nodes.root, nodes.part]
        self._hidden: tuple[Any, int] | None = None
        if len(played.playback.blocks) > LONG_PATH:
            self._hide(op)
            self._nodes.append(_trail(played))
        self._scene: Any = _parent(view.getSceneGraph(), op.ViewObject.RootNode)
        self._scene.ref()  # the view may go before us
        places = [self._scene.findChild(obj.ViewObject.RootNode) for obj in op.Document.Objects]
        first = min(place for place in places if place >= 0)
        for offset, node in enumerate(self._nodes):
            self._scene.insertChild(node, first + offset)

    def clear(self) -> None:
        """Leave the view as it was found; calling it again changes nothing."""
        if self._scene is None:
            return
        for node in self._nodes:
            if self._scene.findChild(node) >= 0:
                self._scene.removeChild(node)
        self._scene.unref()
        self._scene = None
        if self._hidden is not None:
            switch, child = self._hidden
            switch.whichChild = child
            self._hidden = None

    def _hide(self, op: Any) -> None:
        """In the view alone: the document's Visibility is the user's."""
        switch = op.ViewObject.SwitchNode
        self._hidden = switch, switch.whichChild.getValue()
        switch.whichChild = coin.SO_SWITCH_NONE


def _parent(scene: Any, node: Any) -> Any:
    """The group in `scene` that holds `node`: the scene itself or, in newer FreeCADs, one for all objects."""
    search = coin.SoSearchAction()
    search.setNode(node)
    search.setSearchingAll(True)  # hidden ones too
    search.apply(scene)
    return search.getPath().getNodeFromTail(1)


def _trail(played: Played) -> Any:
    tips = played.playback.blocks.tip
    tips = tips[:: len(tips) // TRAIL_POINTS]
    lines = Lines(TRAIL_WIDTH)
    lines.set(tips.tolist(), [CUT_COLORS["two_contacts"]] * len(tips), [len(tips)])
    separator = coin.SoSeparator()
    for node in (unpickable(), unlit(), lines.root):
        separator.addChild(node)
    return separator


def _tool(played: Played) -> list[Any]:
    return [_shape(mesh, TOOL_COLOURS[name]) for name, mesh in tool_solid.meshes(played.tool).items()]


def _shape(mesh: Mesh, colour: tuple[float, float, float]) -> Any:
    material, hints = coin.SoMaterial(), coin.SoShapeHints()
    material.diffuseColor = colour
    hints.vertexOrdering, hints.shapeType = coin.SoShapeHints.COUNTERCLOCKWISE, coin.SoShapeHints.SOLID
    hints.creaseAngle = CREASE_ANGLE
    points, faces = coin.SoCoordinate3(), coin.SoIndexedFaceSet()
    points.point.setValues(0, len(mesh.points), mesh.points.tolist())
    index = np.column_stack((mesh.triangles, np.full(len(mesh.triangles), coin.SO_END_FACE_INDEX)))
    faces.coordIndex.setValues(0, index.size, index.ravel().tolist())
    separator = coin.SoSeparator()
    for node in (hints, material, points, faces):
        separator.addChild(node)
    return separator


def _coin_matrix(matrix: Floats) -> Any:
    """Coin multiplies row vectors from the left."""
    return coin.SbMatrix(*matrix.T.ravel().tolist())
