"""The program of a job: described, written by its post, read back by the control; the proof program; its figures.

What is handed over has been read back.
To add a figure of programs: a field of `ProgramReport`."""

from __future__ import annotations

from .file import check_file
from .making import Made, ProgramFile, ProgramPart, Shop, find_shop, make_program
from .proof import proof_file
from .report import ProgramReport

__all__ = [
    "Made",
    "ProgramFile",
    "Shop",
    "check_file",
    "ProgramPart",
    "ProgramReport",
    "find_shop",
    "make_program",
    "proof_file",
]
