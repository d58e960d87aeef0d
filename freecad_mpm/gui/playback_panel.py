"""The task panel that plays an operation back: slider, buttons, speed, and what is known of the moment."""

from __future__ import annotations

import time
from typing import Any

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..core.base import InputError, one_line
from ..core.playback import describe
from ..document.playback import Played, played
from . import panels
from .playback_nodes import PlaybackNodes, Stage

# Sixty times a second the timer asks; what the machine can draw is drawn.
TICK_MS = 16
# While it plays the words change less often than the picture: painting them takes as long as painting the scene.
WORDS_S = 0.12
SPEEDS = (0.1, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 5000)
DEFAULT_SPEED = 10
PART_FIXED, MACHINE_VIEW = "The part stands still", "The machine stands still"


class PlaybackPanel(panels.ClosingPanel):
    """Shown by FreeCADGui.Control.showDialog; `close` takes everything out of the view again."""

    def __init__(self, op: Any) -> None:
        """Raises InputError when the operation has no up-to-date path."""
        self.op = op
        self.form = PlaybackForm()
        self._place, self._last_tick, self._last_words = 0.0, 0.0, 0.0
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._tick)
        self._connect()
        self._load()
        self._watch = panels.Watch(op, self.reload, self.reject)

    # ------------------------------------------------------------------ moving

    @property
    def place(self) -> float:
        """Where in the path it stands, as core.playback has it."""
        return self._place

    def go_to(self, place: float) -> None:
        """A place as core.playback has it; before the start and after the end the nearest of both."""
        self._move(place)
        self._show_words()

    def go_to_position(self, number: int) -> None:
        """By its number in machining order, from 0."""
        self.go_to(self.played.playback.at_position(number))

    def go_to_move(self, move: int) -> None:
        """To the end of a move of the operation's path, from 0."""
        self.go_to(self.played.playback.at_move(move))

    def step(self, count: int) -> None:
        """To the next position, or with -1 to the one before."""
        playback = self.played.playback
        self.pause()
        if count > 0:
            self.go_to_position(playback.position_after(self._place))
            return
        before = playback.position_before(self._place)
        at_it = before >= 0 and playback.at_position(before) == self._place
        self.go_to_position(max(before - 1 if at_it else before, 0))

    def play(self) -> None:
        """From here, or from the start when it stands at the end; at so many times the machine's own pace."""
        if self._place >= self.played.playback.last:
            self.go_to(0.0)
        self._last_tick = time.perf_counter()
        self._timer.start(TICK_MS)
        self.form.show_playing(True)

    def pause(self) -> None:
        """Stay here; calling it again changes nothing."""
        self._timer.stop()
        self._show_words()
        self.form.show_playing(False)

    def close(self) -> None:
        """Take the nodes out of the view; calling it again changes nothing."""
        self._timer.stop()
        self._stage.clear()
        self._watch.end()

    def reload(self) -> None:
        """The operation was computed anew."""
        self.pause()
        self._stage.clear()
        try:
            self._load()
        except InputError as error:
            FreeCAD.Console.PrintWarning(f"{self.op.Label}: playback ends: {one_line(error)}\n")
            QtCore.QTimer.singleShot(0, self.reject)

    # ------------------------------------------------------------------ inside

    def _load(self) -> None:
        view = panels.view_of(self.op.Document)
        with panels.busy():
            self.played: Played = played(self.op)
            self._nodes = PlaybackNodes(self.played)
        self.form.show_count(len(self.played.playback.visited.move))
        self._stage = Stage(view, self.op, self.played, self._nodes)
        self._show_machine()
        self.go_to(self._place)

    def _move(self, place: float) -> None:
        playback = self.played.playback
        self._place = min(max(place, 0.0), playback.last)
        moment = playback.moment(self._place)
        self._nodes.place(playback.body_matrices(moment, self.form.view.currentText() == PART_FIXED))

    def _show_words(self) -> None:
        playback = self.played.playback
        self._last_words = time.perf_counter()
        self.form.show_words(describe(playback, self._place))
        self.form.show_number(playback.position_before(self._place))

    def _halt_at(self, place: float) -> None:
        self.pause()
        self.go_to(place)

    def _connect(self) -> None:
        form = self.form
        form.first.clicked.connect(lambda: self._halt_at(0.0))
        form.back.clicked.connect(lambda: self.step(-1))
        form.run.clicked.connect(lambda: self.pause() if self._timer.isActive() else self.play())
        form.forth.clicked.connect(lambda: self.step(1))
        form.last.clicked.connect(lambda: self._halt_at(self.played.playback.last))
        form.slider.valueChanged.connect(self.go_to_position)
        form.number.valueChanged.connect(lambda value: self.go_to_position(value - 1))
        form.view.currentIndexChanged.connect(lambda _: self.go_to(self._place))
        form.machine.toggled.connect(lambda _: self._show_machine())

    def _show_machine(self) -> None:
        self._nodes.show_machine(self.form.machine.isChecked())

    def _tick(self) -> None:
        now = time.perf_counter()
        playback = self.played.playback
        seconds = (now - self._last_tick) * self.form.speed_factor
        self._last_tick = now
        self._move(playback.advance(self._place, seconds, self.form.even.isChecked()))
        if now - self._last_words > WORDS_S:
            self._show_words()
        if self._place >= playback.last:
            self.pause()


class PlaybackForm(QtGui.QWidget):
    """The widgets alone."""

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle("Playback")
        layout = QtGui.QVBoxLayout(self)
        self.slider = QtGui.QSlider(QtCore.Qt.Horizontal)
        self.slider.setToolTip("Positions in machining order")
        layout.addWidget(self.slider)
        layout.addLayout(self._buttons())
        self._rows = QtGui.QFormLayout()
        layout.addLayout(self._rows)
        self._add_settings()
        self._words: dict[str, Any] = {}

    @property
    def speed_factor(self) -> float:
        """Seconds of the machine that pass in one of ours."""
        return SPEEDS[self.speed.currentIndex()]

    def show_words(self, words: dict[str, str]) -> None:
        """By the names of their rows; a name that is new gets a row, none is taken away."""
        for name, text in words.items():
            if name not in self._words:
                self._words[name] = _text_field()
                self._rows.addRow(name, self._words[name])
            if self._words[name].text() != text:
                self._words[name].setText(text)

    def show_count(self, positions: int) -> None:
        """Set the ranges of slider and field for so many positions; no signal is sent."""
        for widget, low in ((self.slider, 0), (self.number, 1)):
            widget.blockSignals(True)
            widget.setRange(low, positions - 1 + low)
            widget.blockSignals(False)

    def show_number(self, number: int) -> None:
        """Of the position, from 0 (the field shows it from 1); no signal is sent."""
        for widget, low in ((self.slider, 0), (self.number, 1)):
            widget.blockSignals(True)
            widget.setValue(number + low)
            widget.blockSignals(False)

    def show_playing(self, playing: bool) -> None:
        """Turn the button's icon into what a click on it would do next."""
        style = QtGui.QStyle.SP_MediaPause if playing else QtGui.QStyle.SP_MediaPlay
        self.run.setIcon(self.style().standardIcon(style))

    def _buttons(self) -> Any:
        layout = QtGui.QHBoxLayout()
        style = QtGui.QStyle
        self.first = self._button(layout, style.SP_MediaSkipBackward, "To the start")
        self.back = self._button(layout, style.SP_MediaSeekBackward, "To the position before")
        self.run = self._button(layout, style.SP_MediaPlay, "Play, or pause")
        self.forth = self._button(layout, style.SP_MediaSeekForward, "To the next position")
        self.last = self._button(layout, style.SP_MediaSkipForward, "To the end")
        return layout

    def _button(self, layout: Any, icon: Any, words: str) -> Any:
        button = QtGui.QToolButton()
        button.setIcon(self.style().standardIcon(icon))
        button.setToolTip(words)
        layout.addWidget(button)
        return button

    def _add_settings(self) -> None:
        self.number = QtGui.QSpinBox()
        self.number.setKeyboardTracking(False)  # jump when a number is complete
        self.speed = QtGui.QComboBox()
        self.speed.addItems([f"{speed:g} ×" for speed in SPEEDS])
        self.speed.setCurrentIndex(SPEEDS.index(DEFAULT_SPEED))
        self.speed.setToolTip("Of the machine's own time, by its file's velocities and the feeds")
        self.even = QtGui.QCheckBox()
        self.even.setToolTip("The tip at one speed all along: rapids and slow turns do not stand out")
        self.view = QtGui.QComboBox()
        self.view.addItems([PART_FIXED, MACHINE_VIEW])
        self.machine = QtGui.QCheckBox()
        self.machine.setChecked(True)
        self.machine.setToolTip("A sketch: the axes are the machine file's, the bodies are not")
        for name, widget in (
            ("Go to", self.number),
            ("Speed", self.speed),
            ("Even pace", self.even),
            ("View", self.view),
            ("Show machine", self.machine),
        ):
            self._rows.addRow(name, widget)


def _text_field() -> Any:
    """A line that is only read. A label would have the whole panel laid out anew with every text."""
    field = QtGui.QLineEdit()
    field.setReadOnly(True)
    field.setFrame(False)
    field.setStyleSheet("background: transparent")
    return field


def open_panel(op: Any) -> PlaybackPanel:
    """Show the panel. Raises InputError when it cannot be shown."""
    panels.check_none_is_open()
    panel = PlaybackPanel(op)
    FreeCADGui.Control.showDialog(panel)
    return panel
