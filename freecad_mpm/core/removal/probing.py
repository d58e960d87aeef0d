"""What a probe would measure of a section of the machined surface."""

from __future__ import annotations

import numpy as np

from ..base import Floats
from .cutting import Cut
from .plane_curve import curve
from .section import Section

# Sections beside the one that is probed, a probe's radius to either side.
PROBE_LINES = 16


def probed(cut: Cut, of: Section, radius_mm: float) -> Floats:
    """(N,) mm: the deviation that a measuring machine finds at the points of a section, whose ball of `radius_mm` comes
    down along the normal of the true surface and touches the machined one; the ball's radius is taken off. It rests
    on the highest places within its reach, so narrow grooves come out too high and gouges too shallow.
    """
    spacing = max(2 * radius_mm / PROBE_LINES, 0.0)
    offsets = spacing * np.arange(-PROBE_LINES / 2, PROBE_LINES / 2 + 1)
    cloud = [_touched(cut, of, offset, spacing / 2) for offset in offsets]
    points = np.concatenate([one for one in cloud if len(one)])
    way = (points - of.plane.origin) @ of.plane.along
    order = np.argsort(way)
    return _resting(of, points[order], way[order], radius_mm)


def _touched(cut: Cut, of: Section, offset: float, spacing: float) -> Floats:
    """Points (K, 3) of the machined surface in the plane beside a section; none where that misses the part."""
    origin, normal = of.plane.origin, of.plane.normal
    try:
        beside = curve(cut.scene, (origin + offset * normal).tolist(), normal.tolist(), spacing)
    except ValueError:
        return np.zeros((0, 3))
    return cut.along(beside).machined


def _resting(of: Section, points: Floats, way: Floats, radius_mm: float) -> Floats:
    result = np.full(len(of.points), np.nan)
    s = of.s_mm
    # The ball's centre leaves the plane's line by the normal's lean.
    first, last = np.searchsorted(way, s - radius_mm), np.searchsorted(way, s + radius_mm)
    for i, (point, normal) in enumerate(zip(of.points, of.normals)):
        near = points[first[i] : last[i]] - point
        height = near @ normal
        square = radius_mm**2 - (np.einsum("ij,ij->i", near, near) - height**2)
        reached = square >= 0
        if reached.any():
            result[i] = (height[reached] + np.sqrt(square[reached])).max() - radius_mm
    return result
