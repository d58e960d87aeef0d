"""DIN/ISO of a HEIDENHAIN TNC."""

from __future__ import annotations

import re

from ..reader import AXES, Block, ParsedProgram
from .state import Grammar, Line, blocks_of, text_lines

_AXIS = r"[+-]\d{1,5}(?:\.\d{1,4})?"
_COUNT = r"\d{1,5}"
_RATE = r"\d{1,5}(?:\.\d{1,3})?"
_G_CODES = "00|01|17|30|31|40|90|91"
_M_CODES = "0|2|3|4|5|7|8|9|13|30|91|92|126|127|128|129"
_HEAD = re.compile(r"%([A-Z0-9_]+) G7[01] \*")
_END = re.compile(r"N(\d+) (%.*)")
_COMMENT = re.compile(r"N(\d+) ;[^*%;]*\*")
_TOOL = re.compile(rf"N(\d+) T{_COUNT} G17 S{_RATE}(?: M6)? \*")
_TOLERANCE = re.compile(rf"N(\d+) G62 T{_RATE} P01 [01] P02 {_RATE} \*")
_AXIAL_RETRACT = re.compile(r"N(\d+) M140 MB MAX \*")  # along the tool, as far as the machine goes
_MOTION = re.compile(
    rf"N(\d+)(?: G(?:{_G_CODES}))*"
    + "".join(rf"(?: {axis}{_AXIS})?" for axis in AXES)
    + rf"(?: F{_RATE})?(?: S{_RATE})?(?: T{_COUNT})?(?: M(?:{_M_CODES}))* \*"
)
_WORD = re.compile(r"([A-Z])([+-]?\d+(?:\.\d*)?)")
_NUMBER = re.compile(r"N(\d+)")
_BLANK = (30, 31)


def read(text: str) -> ParsedProgram:
    """Parse a DIN/ISO program. Lines that break the grammar are listed and read as far as they can be."""
    rows, grammar = text_lines(text, "\r\n")
    head = _HEAD.fullmatch(rows[0])
    if not head:
        grammar.append((None, rows[0], "the first line must be %NAME G71 *"))
    end = _END.fullmatch(rows[-1])
    if head and (not end or end[2] != rows[0]):
        wrong_end = f"the last line must repeat {rows[0]} with the end block's number"
        grammar.append((None, rows[-1], wrong_end))
    blocks, wrong = blocks_of(_line(row) for row in rows[1:-1])
    limit = int(end[1]) if end else None
    return ParsedProgram(
        head[1] if head else "",
        blocks,
        grammar + wrong + _number_faults(blocks, limit) + _blank_faults(blocks),
    )


def _line(row: str) -> Line:
    number = _NUMBER.match(row)
    line = Line(row, number=int(number[1]) if number else None)
    if _TOLERANCE.fullmatch(row):
        return line
    if _AXIAL_RETRACT.fullmatch(row):
        line.lost = "XYZ"
        return line
    if not any(form.fullmatch(row) for form in (_MOTION, _COMMENT, _TOOL)):
        line.wrong = "is no block of the control: words, their order or their numbers"
    words = [] if ";" in row else _WORD.findall(row)
    line.g = tuple(int(float(value)) for letter, value in words if letter == "G")
    line.m = tuple(int(float(value)) for letter, value in words if letter == "M")
    if not set(_BLANK) & set(line.g):
        line.words = {letter: float(value) for letter, value in words if letter not in "GMN"}
    line.rapid = True if 0 in line.g else False if 1 in line.g else None
    line.absolute = True if 90 in line.g else False if 91 in line.g else None
    line.compensation_off = 40 in line.g
    line.tcp, line.tcp_ends = True if 128 in line.m else None, 129 in line.m
    line.machine_datum = 91 in line.m or 92 in line.m
    return line


def _number_faults(blocks: list[Block], limit: int | None) -> Grammar:
    """Block numbers rise strictly up to the end block's."""
    wrong: Grammar = []
    last = 0
    for block in blocks:
        number = block.number if block.number is not None else last
        if block.number is not None and number <= last:
            wrong.append((number, block.text, f"its number must be more than the one before, N{last}"))
        last = max(last, number)
    if limit is not None and last >= limit:
        wrong.append((last, "", f"its number must be less than the end block's, N{limit}"))
    return wrong


def _blank_faults(blocks: list[Block]) -> Grammar:
    forms = [code for block in blocks for code in block.g if code in _BLANK]
    if forms in ([], list(_BLANK)):
        return []
    return [(None, "", "the blank form must be one G30 followed by one G31, or be left out")]
