"""DMU 80 P, HEIDENHAIN DIN/ISO with M128: for CAM's Post Process command.

Two faces of one post: FreeCAD 0.20 imports the module and calls `export`, newer ones take the class whose name is the
post's. FreeCAD loads this file by its path, so it imports by absolute names."""

from __future__ import annotations

from typing import Any

from freecad_mpm.core.output import write_atomically
from freecad_mpm.document import compat

POST = "dmu80p"
TOOLTIP = "Five-axis programs of Multi-Point Finish operations for the DMU 80 P (DIN/ISO, M128)"
TOOLTIP_ARGS = "There are no arguments."
UNITS = "G21"  # FreeCAD's word for metric
NO_FILE = "-"


def program_of(objects: list[Any]) -> str:
    """The program of the Multi-Point Finish operations among the objects to post, which are fixtures, tool controllers
    and operations. Raises InputError for operations of another kind."""
    from freecad_mpm.core.errors import InputError
    from freecad_mpm.document import program
    from freecad_mpm.document.operation import is_operation

    for obj in objects:
        if hasattr(obj, "ToolController") and not is_operation(obj):
            raise InputError(
                f"{obj.Label}: the post {POST} writes Multi-Point Finish operations only; deactivate it"
            )
    result = program.program_text([obj for obj in objects if is_operation(obj) and obj.Active], POST)
    program.warn(result)
    return result.text


def export(objectslist: list[Any], filename: str, argstring: str) -> str:
    """FreeCAD 0.20's entry: writes the file, unless it is named "-", and returns its text."""
    text = program_of(objectslist)
    if filename != NO_FILE:
        write_atomically(filename, text)
    return text


Base = compat.post_base()
if Base is not None:

    class Dmu80P(Base):
        """The entry of FreeCAD 1.0 and later, which writes the file itself."""

        def __init__(self, job: Any) -> None:
            super().__init__(job=job, tooltip=TOOLTIP, tooltipargs=TOOLTIP_ARGS, units="Metric")

        tooltip = TOOLTIP
        tooltipArgs = TOOLTIP_ARGS

        def export(self) -> list[tuple[str, str]]:
            return [(section, program_of(objects)) for section, objects in self._buildPostList()]
