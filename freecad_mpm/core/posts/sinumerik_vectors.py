"""Siemens 840D with A3= B3= C3= vectors: no number in it depends on the rotary axes."""

from __future__ import annotations

from . import sinumerik
from .program import Program

FILE_ENDING, DIALECT, OPTIONS = sinumerik.FILE_ENDING, sinumerik.DIALECT, sinumerik.OPTIONS
JOINTS = False


def write(first: Program, *more: Program) -> str:
    """As `sinumerik.write`, with the tool's direction in place of rotary angles."""
    return sinumerik.write(first, *more, vectors=True)
