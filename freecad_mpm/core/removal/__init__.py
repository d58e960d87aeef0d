"""What a path leaves of the stock, and how far that is from the true surface; sections, probe, check faces.

    cut = removal.cut(plan.scene, plan.path, resolution_mm=0.5)
    print(cut.worst(), cut.deviation.deviation_mm.max())

It knows the faces, the tool and where the tool goes, and nothing of how the positions came about. Native: `removal`.
Its word is a second opinion: docs/removal.md, "Accuracy".
To add a check of the cut: a function over `Cut`, as `probed`."""

from __future__ import annotations

from . import bands, memory, mesh_file, plane_curve, planes
from .bands import Bands
from .cutting import NOT_CUT, SECTION_SPACING_MM, Cut, Extreme, cut, cut_rays, default_resolution_mm
from .plane_curve import Curve
from .probing import probed
from .report import CutReport
from .section import Section
from .sweep import Box, PathMoves, tool_sweep

__all__ = [
    "Bands",
    "Box",
    "Curve",
    "Cut",
    "CutReport",
    "Extreme",
    "PathMoves",
    "NOT_CUT",
    "SECTION_SPACING_MM",
    "Section",
    "bands",
    "cut",
    "cut_rays",
    "default_resolution_mm",
    "memory",
    "mesh_file",
    "plane_curve",
    "planes",
    "probed",
    "tool_sweep",
]
