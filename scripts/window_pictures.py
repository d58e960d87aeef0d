"""The pictures of docs/freecad.md: FreeCAD's window with the example part, played back and verified.

    xvfb-run -a -s "-screen 0 1600x1000x24 -dpi 96 +extension GLX" \\
        /usr/bin/python3 scripts/window_pictures.py docs/images

Without the folder they go to out/."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT), str(ROOT / "tests" / "gui")]

from freecad_window import FreeCADWindow  # noqa: E402

from freecad_mpm.core import job  # noqa: E402

EXAMPLE = "bonnet_die"
WIDTH_PX, COLOURS = 1200, 256

PART = """
import Part
import freecad_mpm
doc = FreeCAD.newDocument("{name}")
part = doc.addObject("Part::Feature", "Die")
part.Shape = Part.read({step!r})
part.ViewObject.ShapeColor = (0.72, 0.76, 0.82)
Gui.activateWorkbench("MultiPointMachiningWorkbench")
op = freecad_mpm.create(doc, [(part, {faces!r})], SideStep=6, ForwardStep=3, Machine="table_ac")
view = Gui.ActiveDocument.ActiveView
view.viewIsometric()
view.fitAll()
"""
PLAYBACK = """
from freecad_mpm.gui import playback_panel
panel = playback_panel.open_panel(op)
panel.form.view.setCurrentIndex(1)
panel.go_to_position(int(0.62 * op.Positions))
view.fitAll()
"""
VERIFICATION = """
panel.reject()
op.ViewObject.Visibility = False
from freecad_mpm.document import verification
from freecad_mpm.gui import verification_panel
found = verification.verify(op)
panel = verification_panel.open_panel(found)
view.fitAll()
centre = part.Shape.BoundBox.Center
panel.show_spot(FreeCAD.Vector(centre.x - 12, centre.y + 15, part.Shape.BoundBox.ZMax))
"""


def picture(window: FreeCADWindow, script: str, target: Path) -> None:
    window.run(script)
    shot = window.screenshot(target.stem)
    smaller = ["-resize", f"{WIDTH_PX}x", "-dither", "None", "-colors", str(COLOURS)]
    subprocess.run(["convert", str(shot), *smaller, str(target)], check=True)
    print(target)


def main(folder: Path) -> None:
    spec = job.load(ROOT / "resources" / "examples" / f"{EXAMPLE}.toml")
    folder.mkdir(parents=True, exist_ok=True)
    with FreeCADWindow(Path(tempfile.mkdtemp())) as window:
        window.run(PART.format(name=EXAMPLE, step=str(spec.part.file), faces=spec.part.faces))
        picture(window, PLAYBACK, folder / "playback.png")
        picture(window, VERIFICATION, folder / "verification.png")


main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "out")
