"""What a control makes of a program's text: the dialects read back, kinematics of its own, and all checks.

It never imports `posts`, and nothing that makes a path or a program imports its kinematics: the judge does not depend
on the judged.
To add a check: a function from parsed program to findings, called in `check.py`, and a program broken on purpose."""

from __future__ import annotations

from . import dialects, kinematics
from .check import CheckResult, check_program
from .control import Control
from .kinematics import datum_mm, great_circle
from .moves import ProgramMoves, read_program
from .reader import ParsedProgram

__all__ = [
    "CheckResult",
    "Control",
    "ParsedProgram",
    "ProgramMoves",
    "check_program",
    "datum_mm",
    "dialects",
    "great_circle",
    "kinematics",
    "read_program",
]
