"""A FreeCAD window under the X server of DISPLAY, with a profile of its own: scripts in, answers, mouse and pictures
out. Nothing here counts on something being done after so many milliseconds: `wait_for` asks until it is."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
# Only what will never come takes so long, on a loaded machine too.
LIMIT_S = 300.0
POLL_S = 0.02
LOG_TAIL = 4000
# Of the caller's environment FreeCAD gets these; others (XDG_CONFIG_HOME, QT_SCALE_FACTOR, LANG, ...) would change where
# it looks for its profile, how large its widgets are and what they say.
PASSED_ON = ("PATH", "DISPLAY", "XAUTHORITY", "TMPDIR", "TZ")
SETTINGS = {
    "LC_ALL": "C.UTF-8",
    "LIBGL_ALWAYS_SOFTWARE": "1",
    "QT_QPA_PLATFORM": "xcb",
    # A pixel of the screen is one of Qt's, whatever the screen's resolution.
    "QT_AUTO_SCREEN_SCALE_FACTOR": "0",
    "QT_ENABLE_HIGHDPI_SCALING": "0",
    "QT_FONT_DPI": "96",
}
# What takes seconds on two processors, long enough to click on Cancel, takes seconds where there are more.
PROCESSORS = 2
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
QtGui.QApplication.setDoubleClickInterval(1)  # two clicks on one place are two clicks, however soon

def idle():
    # returns when all events that have come are handled: only then does Qt fire timers of zero
    for _ in range(3):
        loop, timer = QtCore.QEventLoop(), QtCore.QTimer()
        timer.setSingleShot(True)
        timer.timeout.connect(loop.quit)
        timer.start(0)
        (loop.exec_ if hasattr(loop, "exec_") else loop.exec)()

class MouseWatch(QtCore.QObject):
    # tells when a click has arrived in any of the windows
    def begin(self):
        self.released, self._windows = False, QtGui.QGuiApplication.allWindows()
        for one in self._windows:
            one.installEventFilter(self)

    def end(self):
        for one in self._windows:
            try:
                one.removeEventFilter(self)
            except RuntimeError:
                pass  # the click closed this one
        del self._windows

    def eventFilter(self, watched, event):
        self.released = self.released or event.type() == QtCore.QEvent.MouseButtonRelease
        return False

mouse = MouseWatch()

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
    # None while it is hidden; a panel that is longer than the screen is scrolled to it
    above = widget.parentWidget()
    while above is not None:
        if isinstance(above, QtGui.QScrollArea):
            above.ensureWidgetVisible(widget)
        above = above.parentWidget()
    if widget.visibleRegion().isEmpty():
        return None
    centre = widget.mapToGlobal(widget.rect().center())
    return [centre.x(), centre.y()]

def button_of(command):
    for bar in window.findChildren(QtGui.QToolBar):
        for action in bar.actions():
            if action.objectName() == command and bar.widgetForAction(action).isVisible():
                return middle_of(bar.widgetForAction(action))
    raise LookupError(command)

def shown(kind):
    # the visible widgets of a kind; one that Qt is just deleting is none
    found = []
    for widget in window.findChildren(kind):
        try:
            if widget.isVisible():
                found.append(widget)
        except RuntimeError:
            pass
    return found

def panel_button(which):
    # None until a panel is there
    boxes = shown(QtGui.QDialogButtonBox)
    return middle_of(boxes[0].button(which)) if boxes else None

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
for dock in window.findChildren(QtGui.QDockWidget):
    beside = dock.objectName() in ("Combo View", "Model", "Tasks")
    dock.setVisible(beside)
    if beside:
        window.resizeDocks([dock], [420], QtCore.Qt.Horizontal)
"""
MAXIMISED = "window.isActiveWindow() and window.frameGeometry() == window.screen().availableGeometry()"


class FreeCADWindow:
    """Start with `with`; `run` scripts, `wait_for` what they bring about, `click` the mouse, take `screenshot`s."""

    def __init__(self, folder: Path) -> None:
        self._home, self._drop, self._count, self._sent = folder / "home", folder / "drop", 0, ""
        self.log = folder / "freecad.log"

    def __enter__(self) -> FreeCADWindow:
        self._make_profile()
        self._drop.mkdir()
        self._manager = subprocess.Popen(["openbox"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self._process = self._start()
        try:
            self._arrange()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        for process in (self._process, self._manager):
            process.kill()
            process.wait()

    def run(self, script: str) -> Any:
        """Execute `script` in FreeCAD and return what it left in `result`. Raises AssertionError with its traceback."""
        return self.answer(self.send(script))

    def send(self, script: str) -> int:
        """As run, without waiting: for scripts that open a dialog."""
        self._count += 1
        waiting = self._drop / f"{self._count:04d}.tmp"
        waiting.write_text(script, encoding="utf-8")
        waiting.rename(waiting.with_suffix(".py"))
        self._sent = script
        return self._count

    def answer(self, number: int) -> Any:
        out = self._drop / f"{number:04d}.out"
        self.wait_for(out.exists, f"the answer to script {number}, which ends with {self._sent[-200:]!r}")
        reply = json.loads(out.read_text(encoding="utf-8"))
        assert "error" not in reply, reply["error"]
        return reply["value"]

    def wait_for(self, condition: str | Callable[[], Any], what: str) -> Any:
        """Ask until `condition`, an expression in FreeCAD or a function here, is true, and return it.

        Raises AssertionError that names `what` when FreeCAD ends or LIMIT_S have passed."""
        ask = condition if callable(condition) else lambda: self.run(f"result = {condition}")
        end = time.monotonic() + LIMIT_S
        while not (value := ask()):
            ended, late = self._process.poll() is not None, time.monotonic() > end
            assert not ended, f"FreeCAD ended while waiting for {what}\n{self._log_tail()}"
            assert not late, f"waited {LIMIT_S:g} s for {what}; last answer: {value!r}\n{self._log_tail()}"
            time.sleep(POLL_S)
        return value

    def click(self, place: str, hovered: str = "True") -> None:
        """A real mouse click on `place`, an expression that gives [x, y] on the screen; FreeCAD has handled it then.

        The pointer moves there, as a hand's would, until FreeCAD finds the expression `hovered` true."""
        x, y = (round(value) for value in self._at_rest(place))

        def hovers() -> Any:
            for near in (x - 3, x):
                subprocess.run(["xdotool", "mousemove", str(near), str(y)], check=True)
                self.run("idle()")
            return self.run(f"result = {hovered}")

        self.wait_for(hovers, f"{hovered} with the pointer on {place}")
        self.run("mouse.begin()")
        subprocess.run(["xdotool", "click", "1"], check=True)
        self.wait_for("mouse.released", f"the click on {place} to arrive")
        self.run("mouse.end()")

    def type(self, field: str, text: str) -> None:
        """Key presses into `field`, an expression, instead of what stands there; the field loses the focus then."""
        self.run(f"window.activateWindow()\n{field}.setFocus()\n{field}.selectAll()")
        self.wait_for(f"{field}.hasFocus()", f"the focus on {field}")
        subprocess.run(["xdotool", "type", "--delay", "40", text], check=True)
        subprocess.run(["xdotool", "key", "Tab"], check=True)
        self.wait_for(f"not {field}.hasFocus()", f"{field} to take the keys and lose the focus")

    def screenshot(self, name: str) -> Path:
        """The whole screen as out/gui/<name>.png, for people to look at."""
        path = ROOT / "out" / "gui" / f"{name}.png"
        path.parent.mkdir(parents=True, exist_ok=True)
        self.run("Gui.updateGui()\nidle()")
        subprocess.run(["import", "-window", "root", str(path)], check=True)
        return path

    def _start(self) -> subprocess.Popen[bytes]:
        environment = {name: os.environ[name] for name in PASSED_ON if name in os.environ}
        environment |= {**SETTINGS, "HOME": str(self._home), "MPM_DROP": str(self._drop)}
        with open(self.log, "wb") as log:
            return subprocess.Popen(
                [freecad(), str(Path(__file__).with_name("driver.py"))],
                env=environment, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT,
                preexec_fn=lambda: os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:PROCESSORS]),
            )  # fmt: skip

    def _arrange(self) -> None:
        self.wait_for(manages_windows, "a window manager")
        self.run(PRELUDE + "window.showMaximized()\nwindow.activateWindow()")
        self.wait_for(MAXIMISED, "FreeCAD's window all over the screen")
        self.run(ARRANGE)

    def _at_rest(self, place: str) -> list[float]:
        """Where `place` is, once it is to be seen and nothing moves it any more."""
        last = None

        def rests() -> bool:
            nonlocal last
            before, last = last, self.run(f"idle()\nresult = {place}")
            return last is not None and last == before

        self.wait_for(rests, f"{place} to be seen and stand still")
        assert last is not None
        return last

    def _log_tail(self) -> str:
        return self.log.read_text(errors="replace")[-LOG_TAIL:]

    def _make_profile(self) -> None:
        for profile in PROFILES:
            config, data = self._home / ".config" / profile, self._home / ".local/share" / profile
            config.mkdir(parents=True)
            (config / "user.cfg").write_text(USER_CFG, encoding="utf-8")
            (data / "Mod").mkdir(parents=True)
            (data / "Mod" / "MultiPointMachining").symlink_to(ROOT)


def manages_windows() -> bool:
    """Whether a window manager runs: it tells how many desktops there are."""
    return subprocess.run(["xdotool", "get_num_desktops"], capture_output=True).returncode == 0


def freecad() -> str:
    """The program with the window, by whichever name the distribution gives it."""
    found = shutil.which("freecad") or shutil.which("FreeCAD")
    assert found, "FreeCAD is missing: install freecad"
    return found
