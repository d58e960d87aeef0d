"""Klartext of a HEIDENHAIN TNC."""

from __future__ import annotations

import re

from ..reader import ParsedProgram
from .state import Grammar, Line, blocks_of, rising_numbers, text_lines

_AXIS = r"[+-]\d{1,5}(?:\.\d{1,4})?"
_UNIT = r"[+-][01](?:\.\d{1,8})?"
_RATE = r"\d{1,5}(?:\.\d{1,3})?"
_TAIL = rf"(?: R0)?(?: F(?:MAX|{_RATE}))?(?: M(?:3|4|5|7|8|9|13|30|91|92|126|127|128|129))*"
_MOVE = re.compile(r"L" + "".join(rf"(?: {letter}{_AXIS})?" for letter in "XYZABC") + _TAIL)
_VECTOR_MOVE = re.compile(
    "LN"
    + "".join(rf" {letter}{_AXIS}" for letter in "XYZ")
    + rf"(?: NX{_UNIT} NY{_UNIT} NZ{_UNIT})? TX{_UNIT} TY{_UNIT} TZ{_UNIT}"
    + _TAIL
)
_TOOL = re.compile(rf"TOOL CALL \d{{1,5}} Z S{_RATE}(?: DL{_AXIS})?(?: DR{_AXIS})?")
_LONE_M = re.compile(r"M(?:0|2|3|4|5|8|9|13|30|126|127|128|129)")
_TCPM = re.compile(
    r"FUNCTION TCPM F (?:TCP|CONT) AXIS (?:POS|SPAT) PATHCTRL (?:AXIS|VECTOR)|FUNCTION RESET TCPM"
)
_OTHER = re.compile(
    rf"; .*|BLK FORM 0\.1 Z X{_AXIS} Y{_AXIS} Z{_AXIS}|BLK FORM 0\.2 X{_AXIS} Y{_AXIS} Z{_AXIS}"
)
_TOLERANCE = re.compile(rf"CYCL DEF 32\.(?:0 TOLERANCE|1 T{_RATE}|2 HSC-MODE:[01] TA{_RATE})")
_AXIAL_RETRACT = re.compile(r"L M140 MB MAX FMAX")  # along the tool, as far as the machine goes
_WORD = re.compile(r"\b([TN]?[A-Z])([+-]?\d+(?:\.\d+)?)(?= |$)")
_HEAD, _END = re.compile(r"BEGIN PGM ([A-Z0-9_]+) MM"), "END PGM {} MM"


def read(text: str) -> ParsedProgram:
    """Parse a Klartext program. Lines that break the grammar are listed and read as far as they can be."""
    rows, grammar = text_lines(text, "\r\n")
    head = _HEAD.fullmatch(rows[0].partition(" ")[2])
    name = head[1] if head else ""
    if not head:
        grammar.append((None, rows[0], "the first line must be 0 BEGIN PGM NAME MM"))
    if rows[-1].partition(" ")[2] != _END.format(name):
        grammar.append((None, rows[-1], f"the last line must be END PGM {name} MM with its number"))
    blocks, wrong = blocks_of(_line(row) for row in rows[1:-1])
    forms = [row.partition(" ")[2][:12] for row in rows if " BLK FORM " in row]
    return ParsedProgram(
        name, blocks, grammar + wrong + rising_numbers(blocks, step=1) + _blank_faults(forms)
    )


def _blank_faults(forms: list[str]) -> Grammar:
    if forms in ([], ["BLK FORM 0.1", "BLK FORM 0.2"]):
        return []
    return [(None, "", "the blank form must be 0.1 followed by 0.2, or be left out")]


def _line(row: str) -> Line:
    number, _, body = row.partition(" ")
    line = Line(row, number=int(number) if number.isdecimal() else None, absolute=True)
    known = (_MOVE, _VECTOR_MOVE, _TOOL, _LONE_M, _TCPM, _TOLERANCE, _AXIAL_RETRACT, _OTHER)
    if line.number is None or not any(form.fullmatch(body) for form in known):
        line.wrong = "is no block of the control: words, their order or their numbers"
    if body.startswith((";", "BLK", "CYCL")):
        return line
    if _AXIAL_RETRACT.fullmatch(body):
        line.rapid_once, line.lost = True, "XYZ"
        return line
    if body.startswith("FUNCTION"):
        line.tcp = "RESET" not in body
        return line
    pairs = _WORD.findall(body)
    line.m = tuple(int(float(value)) for letter, value in pairs if letter == "M")
    line.words = {letter: float(value) for letter, value in pairs if letter in "XYZABCFS"}
    line.tcp = True if 128 in line.m else None
    line.tcp_ends = 129 in line.m
    if body.startswith("TOOL CALL"):
        line.words = {"T": float(body.split()[2]), "S": line.words.get("S", 0.0)}
    elif body.startswith("L"):
        line.rapid, line.rapid_once = False, " FMAX" in body
        line.compensation_off = True  # R0, given or not: the reader knows no block with R+ or R-
        line.machine_datum = 91 in line.m or 92 in line.m
        vector = dict(pairs)
        if "TX" in vector:
            x, y, z = (float(vector.get(letter, 0.0)) for letter in ("TX", "TY", "TZ"))
            line.axis = (x, y, z)
    return line
