"""What the scripts in posts/ share: from the objects that CAM posts to the text of a program.

Two faces of each post: FreeCAD 0.20 imports the script and calls its `export`, newer ones take the class whose name
is the post's."""

from __future__ import annotations

from typing import Any

from ..core.base import write_atomically
from . import compat, post_arguments

TOOLTIP = "Five-axis programs of Multi-Point Finish operations: {}"
TOOLTIP_ARGS = post_arguments.help_text()
UNITS = "G21"  # FreeCAD's word for metric
NO_FILE = "-"


def program_of(objects: list[Any], post: str, arguments: str = "") -> str:
    """The program of the active operations among the objects to post, which are fixtures, tool controllers and
    operations. Raises InputError for what cannot be written."""
    from . import program

    ops = [obj for obj in objects if hasattr(obj, "ToolController") and getattr(obj, "Active", True)]
    result = program.program_text(ops, post, arguments)
    program.warn(result)
    return result.text


def export(objects: list[Any], filename: str, post: str, arguments: str = "") -> str:
    """FreeCAD 0.20's entry: writes the file, unless it is named "-", and returns its text."""
    text = program_of(objects, post, arguments)
    if filename != NO_FILE:
        write_atomically(filename, text)
    return text


def post_class(post: str, tooltip: str) -> type | None:
    """The entry of FreeCAD 1.0 and later, which writes the file itself; None in 0.20."""
    base: Any = compat.post_base()
    if base is None:
        return None

    class Post(base):
        def __init__(self, job: Any) -> None:
            super().__init__(job=job, tooltip=tooltip, tooltipargs=TOOLTIP_ARGS, units="Metric")

        def export(self) -> list[tuple[str, str]]:
            arguments = self._job.PostProcessorArgs
            return [
                (section, program_of(objects, post, arguments)) for section, objects in self._buildPostList()
            ]

    Post.tooltip, Post.tooltipArgs = tooltip, TOOLTIP_ARGS
    return Post
