"""A FreeCAD window under the X server of DISPLAY, with a profile of its own: scripts in, answers, mouse and pictures
out."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
START_S, ANSWER_S = 90.0, 120.0
POLL_S = 0.05
# FreeCAD 1.1 keeps its profile in folders of its own version; 0.20 and 1.0 do not look there.
PROFILES = ("FreeCAD", "FreeCAD/v1-1")

USER_CFG = """<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp"><FCParamGroup Name="Preferences">
  <FCParamGroup Name="General"><FCText Name="AutoloadModule">PartWorkbench</FCText>
    <FCBool Name="ShowSplasher" Value="0"/></FCParamGroup>
  <FCParamGroup Name="Document"><FCBool Name="RecoveryEnabled" Value="0"/></FCParamGroup>
  <FCParamGroup Name="Units"><FCInt Name="UserSchema" Value="6"/></FCParamGroup>
  <FCParamGroup Name="View"><FCBool Name="ShowNaviCube" Value="0"/></FCParamGroup>
  <FCParamGroup Name="Mod">
    <FCParamGroup Name="Path"><FCBool Name="WarningSuppressVelocity" Value="1"/></FCParamGroup>
    <FCParamGroup Name="CAM"><FCBool Name="WarningSuppressVelocity" Value="1"/></FCParamGroup></FCParamGroup>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""

# Inside FreeCAD: helpers that every script may use.
PRELUDE = """
import os
from PySide import QtCore, QtGui
window = Gui.getMainWindow()

def settle(ms=200):
    loop = QtCore.QEventLoop()
    QtCore.QTimer.singleShot(ms, loop.quit)
    (loop.exec_ if hasattr(loop, "exec_") else loop.exec)()

def view_widget():
    names = ("SIM::Coin3D::Quarter::QuarterWidget", "Gui::View3DInventorViewer")
    return next(w for w in window.findChildren(QtGui.QWidget)
                if w.metaObject().className() in names and w.isVisible())

def on_screen(point):
    widget = view_widget()
    origin = widget.mapToGlobal(QtCore.QPoint(0, 0))
    x, y = Gui.ActiveDocument.ActiveView.getPointOnScreen(point)
    return [origin.x() + x, origin.y() + widget.height() - 1 - y]

def middle_of_face(obj, name):
    face = obj.Shape.getElement(name)
    u0, u1, v0, v1 = face.ParameterRange
    return face.valueAt((u0 + u1) / 2, (v0 + v1) / 2)

def middle_of(widget):
    centre = widget.mapToGlobal(widget.rect().center())
    return [centre.x(), centre.y()]

def button_of(command):
    for bar in window.findChildren(QtGui.QToolBar):
        for action in bar.actions():
            if action.objectName() == command and bar.widgetForAction(action).isVisible():
                return middle_of(bar.widgetForAction(action))
    raise LookupError(command)

def panel_button(which):
    return middle_of(next(box for box in window.findChildren(QtGui.QDialogButtonBox) if box.isVisible()).button(which))

def unfold(obj):
    # shows obj in the tree and its properties below
    Gui.Selection.clearSelection()
    Gui.Selection.addSelection(obj)
    Gui.runCommand("Std_TreeSelection", 0)

def message_box():
    return next((w for w in QtGui.QApplication.topLevelWidgets()
                 if isinstance(w, QtGui.QMessageBox) and w.isVisible()), None)
"""

# The tree and the properties beside the 3D view, and nothing else.
ARRANGE = """
window.showMaximized()
settle(1000)
for dock in window.findChildren(QtGui.QDockWidget):
    beside = dock.objectName() in ("Combo View", "Model", "Tasks")
    dock.setVisible(beside)
    if beside:
        window.resizeDocks([dock], [420], QtCore.Qt.Horizontal)
settle(300)
"""


class FreeCADWindow:
    """Start with `with`; `run` scripts, `click` the mouse, take `screenshot`s."""

    def __init__(self, folder: Path) -> None:
        self._home, self._drop, self._count = folder / "home", folder / "drop", 0
        self.log = folder / "freecad.log"

    def __enter__(self) -> FreeCADWindow:
        self._make_profile()
        self._drop.mkdir()
        environment = {
            **os.environ,
            "HOME": str(self._home),
            "MPM_DROP": str(self._drop),
            "LIBGL_ALWAYS_SOFTWARE": "1",
        }
        environment.pop("PYTHONPATH", None)
        self._manager = subprocess.Popen(["openbox"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        with open(self.log, "wb") as log:
            self._process = subprocess.Popen(
                [freecad(), str(Path(__file__).with_name("driver.py"))],
                env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
            )  # fmt: skip
        self.run(PRELUDE + ARRANGE, timeout_s=START_S)
        return self

    def __exit__(self, *_: object) -> None:
        for process in (self._process, self._manager):
            process.kill()
            process.wait()

    def run(self, script: str, timeout_s: float = ANSWER_S) -> Any:
        """Execute `script` in FreeCAD and return what it left in `result`. Raises AssertionError with its traceback."""
        return self.answer(self.send(script), timeout_s)

    def send(self, script: str) -> int:
        """As run, without waiting: for scripts that open a dialog."""
        self._count += 1
        waiting = self._drop / f"{self._count:04d}.tmp"
        waiting.write_text(script, encoding="utf-8")
        waiting.rename(waiting.with_suffix(".py"))
        return self._count

    def answer(self, number: int, timeout_s: float = ANSWER_S) -> Any:
        out = self._drop / f"{number:04d}.out"
        self.wait(out.exists, timeout_s)
        reply = json.loads(out.read_text(encoding="utf-8"))
        assert "error" not in reply, reply["error"]
        return reply["value"]

    def wait(self, condition: Any, timeout_s: float = ANSWER_S) -> None:
        end = time.monotonic() + timeout_s
        while not condition():
            assert (
                self._process.poll() is None
            ), f"FreeCAD ended:\n{self.log.read_text(errors='replace')[-4000:]}"
            assert (
                time.monotonic() < end
            ), f"no answer in {timeout_s} s:\n{self.log.read_text(errors='replace')[-4000:]}"
            time.sleep(POLL_S)

    def click(self, position: list[int]) -> None:
        """A real mouse click. It comes in two steps: a jump alone would preselect nothing."""
        x, y = (round(value) for value in position)
        steps = f"mousemove {x - 3} {y} sleep 0.4 mousemove {x} {y} sleep 0.5 click 1 sleep 0.3"
        subprocess.run(["xdotool", *steps.split()], check=True)

    def type(self, text: str) -> None:
        """Key presses into the widget that has the focus, which then loses it."""
        subprocess.run(["xdotool", "type", "--delay", "40", text], check=True)
        subprocess.run(["xdotool", "key", "Tab"], check=True)

    def screenshot(self, name: str) -> Path:
        """The whole screen as out/gui/<name>.png, for people to look at."""
        path = ROOT / "out" / "gui" / f"{name}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["import", "-window", "root", str(path)], check=True)
        return path

    def _make_profile(self) -> None:
        for profile in PROFILES:
            config, data = self._home / ".config" / profile, self._home / ".local/share" / profile
            config.mkdir(parents=True)
            (config / "user.cfg").write_text(USER_CFG, encoding="utf-8")
            (data / "Mod").mkdir(parents=True)
            (data / "Mod" / "MultiPointMachining").symlink_to(ROOT)


def freecad() -> str:
    """The program with the window, by whichever name the distribution gives it."""
    found = shutil.which("freecad") or shutil.which("FreeCAD")
    assert found, "FreeCAD is missing: install freecad"
    return found
