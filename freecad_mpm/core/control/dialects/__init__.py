"""Readers of all dialects. A reader knows its control's grammar and shares nothing with the writers."""

from __future__ import annotations

import re
from collections.abc import Callable

from ...base import InputError
from ..reader import ParsedProgram
from . import apt, din_iso, gcode, klartext

Reader = Callable[[str], ParsedProgram]

READERS: dict[str, Reader] = {
    "din_iso": din_iso.read,
    "klartext": klartext.read,
    "linuxcnc": gcode.read_linuxcnc,
    "sinumerik": gcode.read_sinumerik,
    "fanuc": gcode.read_fanuc,
    "apt": apt.read,
}
# What a program of the dialect has and none of the others before it in this order.
_SIGNS = {
    "din_iso": r"\A%\w+ G7[01]",
    "klartext": r"\A\s*0 BEGIN PGM",
    "apt": r"\APARTNO",
    "sinumerik": r"\bTRA(?:ORI|FOOF)\b",
    "fanuc": r"\A%\r?\nO\d",
    "linuxcnc": r"\A\([A-Z0-9_]+ - ",
}


def read(text: str, dialect: str | None = None) -> ParsedProgram:
    """The program of a text; dialect None: the one that it looks like. Raises InputError naming those there are."""
    name = dialect or next((name for name, sign in _SIGNS.items() if re.search(sign, text)), None)
    if name not in READERS:
        raise InputError(
            f"dialect '{name or 'unknown'}': cannot be read; it must be one of {', '.join(READERS)}"
        )
    return READERS[name](text)
