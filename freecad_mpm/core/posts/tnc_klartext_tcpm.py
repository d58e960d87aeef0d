"""Klartext for a HEIDENHAIN TNC with FUNCTION TCPM, which later controls prefer to M128."""

from __future__ import annotations

from . import tnc_klartext
from .program import Program

FILE_ENDING = tnc_klartext.FILE_ENDING
DIALECT = tnc_klartext.DIALECT
OPTIONS = tnc_klartext.Options(
    tcp_on="FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS", tcp_off="FUNCTION RESET TCPM"
)


def write(program: Program) -> str:
    return tnc_klartext.write(program, OPTIONS)
