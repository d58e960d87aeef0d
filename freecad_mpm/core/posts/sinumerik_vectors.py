"""Siemens 840D with A3= B3= C3= vectors: no number in it depends on the rotary axes."""

from __future__ import annotations

from . import sinumerik
from .program import Program

FILE_ENDING = sinumerik.FILE_ENDING
DIALECT = sinumerik.DIALECT
OPTIONS = sinumerik.Options(orientation="vectors")


def write(program: Program) -> str:
    return sinumerik.write(program, OPTIONS)
