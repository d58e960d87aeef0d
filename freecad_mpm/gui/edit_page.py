"""The operation's page in CAM's task panel: one field a property."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from PySide import QtGui

from ..document import compat, properties
from ..document.job_spec import plain
from . import panels

QUANTITY_UNITS = {"Length": "mm", "Distance": "mm", "Angle": "deg"}


@dataclass(frozen=True)
class Field:
    """A widget and how it holds a property's value."""

    name: str
    widget: Any
    read: Callable[[], Any]
    write: Callable[[Any], None]
    changed: Any  # the signal
    holder: Any = None  # of the widget, where it does not stand in the form itself

    def to_property(self, obj: Any) -> None:
        """Assign only what differs: an assignment makes the operation recompute."""
        if self.read() != plain(getattr(obj, self.name)):
            setattr(obj, self.name, self.read())

    def from_property(self, obj: Any) -> None:
        """Show the property's value; the widget sends no signal, so nothing recomputes."""
        self.widget.blockSignals(True)
        self.write(plain(getattr(obj, self.name)))
        self.widget.blockSignals(False)


class EditPage(compat.op_gui.TaskPanelPage):
    """The module and class name are written into documents: never rename them."""

    def getForm(self) -> Any:
        form = QtGui.QWidget()
        layout = QtGui.QFormLayout(form)
        form.toolController, form.coolantController = QtGui.QComboBox(), QtGui.QComboBox()
        layout.addRow("Tool controller", form.toolController)
        layout.addRow("Coolant", form.coolantController)
        self._fields = [_field(self.obj, one) for one in properties.settings()]
        for one, field in zip(properties.settings(), self._fields):
            field.widget.setToolTip(one.doc)
            layout.addRow(_words(one.name), field.holder or field.widget)
        self._result = QtGui.QLabel()
        self._result.setWordWrap(True)
        layout.addRow(self._result)
        return form

    def getFields(self, obj: Any) -> None:
        for field in self._fields:
            field.to_property(obj)
        self.updateToolController(obj, self.form.toolController)
        self.updateCoolant(obj, self.form.coolantController)

    def setFields(self, obj: Any) -> None:
        for field in self._fields:
            field.from_property(obj)
        self.setupToolController(obj, self.form.toolController)
        self.setupCoolant(obj, self.form.coolantController)
        self._show_result(obj)

    def getSignalsForUpdate(self, obj: Any) -> list[Any]:
        combos = [self.form.toolController, self.form.coolantController]
        return [field.changed for field in self._fields] + [combo.currentIndexChanged for combo in combos]

    def updateData(self, obj: Any, prop: str) -> None:
        if prop in ("Problem", "Report"):
            self._show_result(obj)

    def _show_result(self, obj: Any) -> None:
        self._result.setText(f"No path: {obj.Problem}" if obj.Problem else ", ".join(obj.Statuses))


def _field(obj: Any, one: properties.Property) -> Field:
    if one.type in QUANTITY_UNITS:
        return _quantity_field(one)
    if one.type == "Enumeration":
        return _choice_field(obj, one)
    return _flag_field(one)


def _quantity_field(one: properties.Property) -> Field:
    holder, box = panels.quantity_field(QUANTITY_UNITS[one.type])
    return Field(
        one.name,
        box,
        lambda: box.property("rawValue"),
        lambda v: box.setProperty("rawValue", v),
        box.editingFinished,
        holder,
    )


def _choice_field(obj: Any, one: properties.Property) -> Field:
    box = QtGui.QComboBox()
    box.addItems(obj.getEnumerationsOfProperty(one.name))
    return Field(
        one.name,
        box,
        box.currentText,
        lambda v: box.setCurrentIndex(box.findText(v)),
        box.currentIndexChanged,
    )


def _flag_field(one: properties.Property) -> Field:
    box = QtGui.QCheckBox()
    return Field(one.name, box, box.isChecked, box.setChecked, box.toggled)


def _words(name: str) -> str:
    """SideStep -> Side step."""
    return "".join(f" {c.lower()}" if c.isupper() else c for c in name).strip().capitalize()
