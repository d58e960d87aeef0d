"""Fanuc 30i class with I J K vectors (G43.5): no number in it depends on the rotary axes but the start and the end."""

from __future__ import annotations

from . import fanuc
from .program import Program

FILE_ENDING, DIALECT, OPTIONS = fanuc.FILE_ENDING, fanuc.DIALECT, fanuc.OPTIONS
JOINTS = False


def write(first: Program, *more: Program) -> str:
    """As `fanuc.write`, with the tool's direction in place of rotary angles."""
    return fanuc.write(first, *more, vectors=True)
