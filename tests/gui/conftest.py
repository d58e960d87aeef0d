"""One FreeCAD window for all window tests; they share it, each with a document of its own."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest
from freecad_window import FreeCADWindow


@pytest.fixture(scope="session")
def window(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FreeCADWindow]:
    if "DISPLAY" not in os.environ:
        pytest.fail("DISPLAY: must name an X server: run these tests with ./dev test, which starts one")
    with FreeCADWindow(tmp_path_factory.mktemp("freecad")) as running:
        running.run(REMEMBER_PANEL)
        yield running


@pytest.fixture
def part(window: FreeCADWindow) -> Iterator[None]:
    """A document with one block whose top, Face1, is a free-form face; the 3D view shows it."""
    window.run(MAKE_PART)
    yield
    window.run(
        "panel = None\nGui.Control.closeDialog()\n"
        "for name in list(FreeCAD.listDocuments()): FreeCAD.closeDocument(name)"
    )


# `panel` is the one that was opened last, once it is whole and shown.
REMEMBER_PANEL = """
from freecad_mpm.gui import playback_panel, verification_panel
panel = None

def remember(module):
    open_panel = module.open_panel
    def opened(*arguments):
        global panel
        panel = open_panel(*arguments)
        return panel
    module.open_panel = opened

remember(playback_panel)
remember(verification_panel)
"""

MAKE_PART = """
import math
import Part
doc = FreeCAD.newDocument("window_test")
heights = [[FreeCAD.Vector(x, y, 6 * math.sin(x / 22) * math.cos(y / 18)) for y in range(0, 81, 10)]
           for x in range(0, 121, 10)]
surface = Part.BSplineSurface()
surface.interpolate(heights)
block = doc.addObject("Part::Feature", "Block")
block.Shape = surface.toShape().extrude(FreeCAD.Vector(0, 0, -30))
top = next(f"Face{i}" for i, face in enumerate(block.Shape.Faces, 1) if face.CenterOfMass.z > -2)
block.ViewObject.ShapeColor = (0.72, 0.76, 0.82)
doc.recompute()
Gui.activateWorkbench("MultiPointMachiningWorkbench")
view = Gui.ActiveDocument.ActiveView
view.viewIsometric()
view.fitAll()
Gui.updateGui()
"""
