"""The part of a path that takes material away, in the set-up frame, as the native removal wants it."""

from __future__ import annotations

from typing import NamedTuple, Protocol

import numpy as np

from ... import _core
from ..base import Flags, Floats, Names
from ..part import Scene

# Moves of these kinds take nothing away, whatever they run through.
NOT_CUTTING = ("rapid",)


class PathMoves(Protocol):
    """What is needed of a path: `kind` (M,) names, `tip` and `axis` (M, 3), part frame, mm."""

    @property
    def kind(self) -> Names:
        """(M,) names; moves of NOT_CUTTING take nothing away."""

    @property
    def tip(self) -> Floats:
        """(M, 3) mm, part frame: where the move ends."""

    @property
    def axis(self) -> Floats:
        """(M, 3) unit, part frame, from the tip to the spindle, where the move ends."""


class Box(NamedTuple):
    """A box lo..hi (3,), mm."""

    lo: Floats
    hi: Floats


def way(scene: Scene, path: PathMoves) -> tuple[Floats, Floats, Flags]:
    """tip, axis (M, 3) in the set-up frame; (M,): the move that ends in the row takes material away."""
    frame = scene.frame
    removes = ~np.isin(path.kind, NOT_CUTTING)
    return frame.to_setup(path.tip), frame.direction_to_setup(path.axis), removes


def tool_sweep(scene: Scene, path: PathMoves) -> _core.ToolSweep:
    """The native sweep of a path by the scene's tool."""
    return _core.ToolSweep(scene.tool, *way(scene, path))


def reach(scene: Scene, path: PathMoves) -> Box:
    """A box (set-up frame) that holds the whole tool at all poses that a removing move begins or ends in."""
    tip, axis, removes = way(scene, path)
    removes[:1] = False
    used = removes | np.append(removes[1:], False)
    ends = np.concatenate((tip[used], (tip + scene.tool.length * axis)[used]))
    if not len(ends):
        return Box(np.full(3, np.inf), np.full(3, -np.inf))
    return Box(ends.min(axis=0) - scene.tool.reach, ends.max(axis=0) + scene.tool.reach)
