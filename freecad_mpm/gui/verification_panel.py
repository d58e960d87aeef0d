"""The task panel of a verification: the worst places, the bands, and which position cut the spot that is clicked."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCADGui
from PySide import QtCore, QtGui

from ..core.base import Cancelled, InputError
from ..core.removal import bands as deviation_bands
from ..document import verification
from ..document.deviation import deviation_of
from ..document.playback import Played, played
from . import panels, playback_panel
from .messages import report
from .playback_nodes import PlaybackNodes, Stage
from .spot_node import SpotNode

CLICKS = "SoMouseButtonEvent"
SWATCH_PX = 16
LEAST_RESOLUTION_MM = 0.001
# A click takes a point that it passes within so many spacings of the points.
PICK_REACH = 1.5
HINT = "Click on a coloured spot in the 3D view."


class VerificationPanel(panels.ClosingPanel):
    """Shown by FreeCADGui.Control.showDialog; `close` takes everything out of the view again."""

    def __init__(self, result: Any) -> None:
        self.result = result
        self.form = VerificationForm(result)
        self.move = verification.NO_MOVE  # that cut the spot last
        self._found = deviation_of(result)
        self._view = panels.view_of(result.Document)
        # Not the one with Coin's own events: of their position FreeCAD 1.1's pivy gives no more than a pointer.
        self._callback = self._view.addEventCallback(CLICKS, self._clicked)
        self._spot = SpotNode(self._view)
        self._stage: Stage | None = None
        self._watch = panels.Watch(result, self._recomputed, self.reject)
        with panels.busy():
            self._played = None if _is_history(result) else played(result.Operation)
        self.form.gouge.clicked.connect(lambda: self.show_spot(result.WorstGougePoint))
        self.form.remainder.clicked.connect(lambda: self.show_spot(result.WorstRemainderPoint))
        self.form.check.clicked.connect(lambda: self.show_spot(result.WorstCheckGougePoint))
        self.form.play.clicked.connect(self.play_from_here)
        self.form.again.clicked.connect(self.verify_again)

    # ------------------------------------------------------------------ spots

    def show_spot(self, point: Any) -> None:
        """Mark the point of the deviation nearest to `point`, and put the tool where the move that cut it last ends."""
        row = self._found.nearest(point)
        at, self.move = self._found.points[row], int(self._found.move[row])
        self._spot.show(at)
        self.form.show_spot(at, float(self._found.deviation_mm[row]), self._cut_by())
        self.form.play.setEnabled(self._knows_the_move())
        self._show_tool()

    def play_from_here(self) -> None:
        """Close, and open a playback at the end of the move that cut the spot last."""
        op, move = self.result.Operation, self.move
        self._leave_for(lambda: playback_panel.open_panel(op).go_to_move(move))

    def verify_again(self) -> None:
        """With the resolution of the field; a panel of the new result takes the place of this one."""
        op, resolution_mm = self.result.Operation, self.form.resolution.property("rawValue")
        self._leave_for(lambda: run_and_show(op, resolution_mm))

    def close(self) -> None:
        """Calling it again changes nothing."""
        if self._watch.active:
            self._view.removeEventCallback(CLICKS, self._callback)
            self._spot.clear()
        self._watch.end()
        self._clear_tool()

    # ------------------------------------------------------------------ inside

    def _leave_for(self, following: Callable[[], Any]) -> None:
        """Close, then go on: not now, for closing deletes the button whose click this is."""
        QtCore.QTimer.singleShot(0, self.reject)
        QtCore.QTimer.singleShot(0, following)

    def _recomputed(self) -> None:
        """The moves that the result knows may be others now."""
        if _is_history(self.result):
            self._played = None
            self._clear_tool()
            self.form.show_history(True)

    def _clear_tool(self) -> None:
        if self._stage is not None:
            self._stage.clear()
            self._stage = None

    def _clicked(self, event: dict[str, Any]) -> None:
        if event["Button"] != "BUTTON1" or event["State"] != "DOWN":
            return
        start, end = self._view.projectPointToLine(*event["Position"])
        row = self._found.first_on_line(start, end, PICK_REACH * self.result.Resolution.Value)
        if row is not None:
            self.show_spot(self._found.points[row])

    def _knows_the_move(self) -> bool:
        return self._played is not None and self.move != verification.NO_MOVE

    def _cut_by(self) -> str:
        if self.move == verification.NO_MOVE:
            return "no move"
        if self._played is None:
            return f"move {self.move + 1} of the path as it was"
        position = verification.position_at(self.result.Operation, self.move)
        if position == verification.NO_POSITION:
            return f"move {self.move + 1}, between positions"
        return f"move {self.move + 1}, position {position + 1} of {len(self._played.playback.visited.move)}"

    def _show_tool(self) -> None:
        if self._played is None or self.move == verification.NO_MOVE:
            self._clear_tool()
            return
        playback = self._played.playback
        moment = playback.moment(playback.at_move(self.move))
        self._nodes_in_view(self._played).place(playback.body_matrices(moment, part_fixed=True))

    def _nodes_in_view(self, shown: Played) -> PlaybackNodes:
        if self._stage is None:
            self._nodes = PlaybackNodes(shown)
            self._nodes.show_machine(False)
            self._stage = Stage(self._view, self.result.Operation, shown, self._nodes)
        return self._nodes


def _is_history(result: Any) -> bool:
    """The path that was cut is no longer there."""
    return result.Outdated or result.Operation is None


def _deepest_words(depth_mm: float) -> str:
    return deviation_bands.length(depth_mm) if depth_mm < 0 else "none is cut"


class VerificationForm(QtGui.QWidget):
    """The widgets alone."""

    def __init__(self, result: Any) -> None:
        super().__init__()
        self.setWindowTitle("Verification")
        layout = QtGui.QFormLayout(self)
        self._history = QtGui.QLabel("<b>The path has changed since: verify again.</b>")
        layout.addRow(self._history)
        self.gouge = QtGui.QPushButton(deviation_bands.length(result.WorstGouge.Value))
        self.remainder = QtGui.QPushButton(deviation_bands.length(result.WorstRemainder.Value))
        layout.addRow("Least deviation", self.gouge)
        layout.addRow("Most that remains", self.remainder)
        self.check = QtGui.QPushButton(_deepest_words(result.WorstCheckGouge.Value))
        self.check.setEnabled(result.WorstCheckGouge.Value < 0)
        layout.addRow("Deepest in other faces", self.check)
        field, self.resolution = panels.quantity_field("mm")
        self.resolution.setProperty("minimum", LEAST_RESOLUTION_MM)
        self.resolution.setProperty("rawValue", result.Resolution.Value)
        self.resolution.setToolTip("Distance of the points looked at; their deviations do not depend on it")
        self.again = QtGui.QPushButton("Verify again")
        self.again.setEnabled(result.Operation is not None)
        layout.addRow("Resolution", field)
        layout.addRow(self.again)
        self._add_bands(layout, result)
        self._hint = QtGui.QLabel(HINT)
        layout.addRow(self._hint)
        self._spot = {name: QtGui.QLabel("–") for name in ("Deviation", "Point", "Cut last by")}
        for name, label in self._spot.items():
            layout.addRow(name, label)
        self.play = QtGui.QPushButton("Play back from here")
        self.play.setEnabled(False)
        layout.addRow(self.play)
        self.show_history(_is_history(result))

    def show_history(self, shown: bool) -> None:
        """Whether the result is of a path that is no more: then there is nothing to play."""
        self._history.setVisible(shown)
        if shown:
            self.play.setEnabled(False)

    def show_spot(self, point: Any, deviation_mm: float, cut_by: str) -> None:
        """point: (3,) mm in FreeCAD's global frame."""
        words = (deviation_bands.length(deviation_mm), ", ".join(f"{value:.3f}" for value in point), cut_by)
        for label, text in zip(self._spot.values(), words):
            label.setText(text)

    def spot_words(self) -> dict[str, str]:
        """What is shown of the spot, by the names of its rows; dashes before the first click."""
        return {name: label.text() for name, label in self._spot.items()}

    def _add_bands(self, layout: Any, result: Any) -> None:
        bands = deviation_bands.bands(result.Tolerance.Value)
        shares = dict(line.rsplit(": ", 1) for line in result.Bands)
        for name, colour in zip(bands.names, deviation_bands.COLOURS):
            if name in shares:
                swatch = QtGui.QPixmap(SWATCH_PX, SWATCH_PX)
                swatch.fill(QtGui.QColor.fromRgbF(*colour))
                picture = QtGui.QLabel()
                picture.setPixmap(swatch)
                layout.addRow(picture, QtGui.QLabel(f"{name}: {shares[name]}"))


def run_and_show(op: Any, resolution_mm: float | None = None) -> None:
    """Verify as one step to undo, then show the result; a failure is told in a dialog."""
    op.Document.openTransaction("Verify")
    try:
        panels.check_none_is_open()
        result = verification.verify(op, resolution_mm)
    except Exception as error:
        op.Document.abortTransaction()
        if not isinstance(error, Cancelled):
            report(error)
        return
    op.Document.commitTransaction()
    open_panel(result)


def open_panel(result: Any) -> VerificationPanel:
    """Show the panel. Raises InputError when it cannot be shown."""
    panels.check_none_is_open()
    if not result.Data:
        raise InputError(f"{result.Label}: holds no result; verify the operation again")
    panel = VerificationPanel(result)
    FreeCADGui.Control.showDialog(panel)
    return panel
