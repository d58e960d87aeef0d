"""FreeCAD's own Post Process command, pressed without a window."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import FreeCAD

from freecad_mpm.document import compat


def post_process(job: Any, path: Path) -> bytes:
    """What the command writes for `job` to `path`."""
    job.PostProcessorOutputFile = str(path)
    if compat.FLAT_MODULES:
        _post_process_0_20(job)
    else:
        _post_process_1_0(job)
    return path.read_bytes()


def _post_process_0_20(job: Any) -> None:
    from PathScripts.PathPost import CommandPathPost

    command = CommandPathPost()
    for objects in command.buildPostList(job):
        command.exportObjectsWith(objects, job)


def _post_process_1_0(job: Any) -> None:
    from Path.Post.Command import CommandPathPost

    command = CommandPathPost()
    command.candidate = job
    FreeCAD.setActiveDocument(job.Document.Name)
    command.Activated()
