"""Klartext for a HEIDENHAIN TNC with FUNCTION TCPM, which later controls prefer to M128."""

from __future__ import annotations

from . import tnc_klartext
from .program import Program

FILE_ENDING, DIALECT, OPTIONS = tnc_klartext.FILE_ENDING, tnc_klartext.DIALECT, tnc_klartext.OPTIONS
JOINTS = False
FORM = tnc_klartext.Form("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS", "FUNCTION RESET TCPM")


def write(first: Program, *more: Program) -> str:
    """As `tnc_klartext.write`, in the form at the head of this file."""
    return tnc_klartext.write(first, *more, form=FORM)
