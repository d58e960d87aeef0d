"""Where tool and machine are at any moment, by time, way or position; their bodies as meshes.

The machine is a sketch, never used to judge a collision.
To add a body: its mesh in `sketch.py`, its matrix in `bodies.py`."""

from __future__ import annotations

from . import playback, sketch, tool_solid
from .bodies import PART, TOOL
from .playback import Playback, Visited, describe, make_playback
from .style import TOOL_COLOURS, Colour, colour_of, table_letters
from .tool_solid import Mesh

__all__ = [
    "Colour",
    "Mesh",
    "PART",
    "Playback",
    "TOOL",
    "TOOL_COLOURS",
    "Visited",
    "colour_of",
    "describe",
    "make_playback",
    "playback",
    "sketch",
    "table_letters",
    "tool_solid",
]
