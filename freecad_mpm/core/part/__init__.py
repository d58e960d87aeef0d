"""The part: faces from a file or a document as arrays, and with the tool as native objects in the set-up frame.

Native: `occt`, `surface`, `tool`. `prepare` is the way in for a job.
To add a file format: a reader that gives `FaceArrays`, and its ending in `file.py`."""

from __future__ import annotations

from . import file
from .faces import FaceArrays
from .frame import Frame
from .info import info_lines
from .mesh import quads
from .scene import Scene, build_scene, prepare, surface_model

__all__ = [
    "FaceArrays",
    "Frame",
    "Scene",
    "build_scene",
    "file",
    "info_lines",
    "prepare",
    "quads",
    "surface_model",
]
