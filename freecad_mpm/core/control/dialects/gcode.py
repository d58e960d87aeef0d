"""The dialects of ISO 6983: LinuxCNC, Siemens 840D, Fanuc 30i class."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..reader import ParsedProgram
from .state import Grammar, Line, blocks_of, rising_numbers, text_lines


@dataclass(frozen=True)
class Rules:
    """What a control takes; codes as they are written."""

    g: frozenset[str]
    m: frozenset[int]
    comment: re.Pattern[str]  # removed before the words are read
    tcp_on: frozenset[str] = frozenset()
    tcp_off: frozenset[str] = frozenset()
    keywords: frozenset[str] = frozenset()
    vector: tuple[str, str, str] | None = None
    axis_number: re.Pattern[str] = re.compile(r"-?\d{1,6}(?:\.\d{0,8})?")
    call: re.Pattern[str] | None = None  # of a cycle, in a block of its own
    datum_words: frozenset[str] = frozenset()  # coordinates of the machine's own in this block


def _codes(text: str) -> frozenset[str]:
    return frozenset(text.split())


_PLAIN_M = frozenset((0, 2, 3, 4, 5, 6, 7, 8, 9, 30))
_MODES = "G17 G21 G40 G49 G80 G90 G94"
_BRACKETS = re.compile(r"\([^()]*\)")
LINUXCNC = Rules(
    g=_codes(f"G0 G1 G43 G53 G54 G61 G64 G93 {_MODES}"),
    m=_PLAIN_M | {428, 429},
    comment=_BRACKETS,
    tcp_on=_codes("M428"),
    tcp_off=_codes("M429"),
    datum_words=_codes("G53"),
)
SINUMERIK = Rules(
    g=_codes("G0 G1 G17 G40 G54 G71 G90 G93 G94"),
    m=_PLAIN_M,
    comment=re.compile(r";.*"),
    tcp_on=_codes("TRAORI"),
    tcp_off=_codes("TRAFOOF"),
    keywords=_codes("ORIWKS ORIMKS ORIAXES ORIVECT SUPA"),
    vector=("A3", "B3", "C3"),
    call=re.compile(r"N\d+ CYCLE832\([\d.]+,_ORI_(?:FINISH|ROUGH),[\d.]+\)"),
    datum_words=_codes("SUPA"),
)
FANUC = Rules(
    g=_codes(f"G0 G1 G28 G43 G43.4 G43.5 G54 G91 G93 {_MODES}"),
    m=_PLAIN_M,
    comment=_BRACKETS,
    tcp_on=_codes("G43.4 G43.5"),
    tcp_off=_codes("G49"),
    vector=("I", "J", "K"),
    axis_number=re.compile(r"-?\d{1,6}\.\d{0,8}"),  # without the point the control reads thousandths
)

_WORD = re.compile(r"([A-Z]{2,}(?![\d=])|[A-Z]\d=|[A-Z])([+-]?[\d.]*)")
_AXES = "XYZABC"
_SINGLE = frozenset("NXYZABCIJKFSTHDOPQ")


def read_linuxcnc(text: str) -> ParsedProgram:
    """Lines end with LF, the program with M30; what is wrong stands in `grammar`."""
    rows, grammar = text_lines(text, "\n")
    blocks, wrong = blocks_of(_with_inverse_time(_line(row, LINUXCNC) for row in rows))
    return ParsedProgram(_name(rows[0]), blocks, grammar + wrong + _ending(rows, "M30"))


def read_sinumerik(text: str) -> ParsedProgram:
    """As LinuxCNC, with block numbers that must rise; what is wrong stands in `grammar`."""
    rows, grammar = text_lines(text, "\n")
    blocks, wrong = blocks_of(_with_inverse_time(_line(row, SINUMERIK) for row in rows))
    grammar += wrong + rising_numbers(blocks) + _ending(rows, "M30")
    return ParsedProgram(_name(rows[0]), blocks, grammar)


def read_fanuc(text: str) -> ParsedProgram:
    """Lines end with CRLF, between two of % and named by Onnnn; what is wrong stands in `grammar`."""
    rows, grammar = text_lines(text, "\r\n")
    if len(rows) < 3 or rows[0] != "%" or rows[-1] != "%" or not re.match(r"O\d{4}\b", rows[1]):
        grammar.append((None, rows[0], "the program must start with % and Onnnn and end with %"))
    blocks, wrong = blocks_of(_with_inverse_time(_line(row, FANUC) for row in rows[2:-1]))
    return ParsedProgram(
        _name(rows[1] if len(rows) > 1 else ""), blocks, grammar + wrong + _ending(rows[:-1], "M30")
    )


def _name(row: str) -> str:
    found = re.search(r"[(;] ?([A-Z0-9_]{1,16}) - ", row)
    return found[1] if found else ""


def _ending(rows: list[str], word: str) -> Grammar:
    ends = [row for row in rows if row.split()[-1:] == [word]]
    return (
        [] if len(ends) == 1 and rows[-1] == ends[0] else [(None, rows[-1], f"the last block must be {word}")]
    )


def _with_inverse_time(lines: Iterator[Line]) -> Iterator[Line]:
    """G93: every feed move has an F of its own."""
    inverse, rapid = False, True
    for line in lines:
        inverse = True if 93 in line.g else False if 94 in line.g else inverse
        rapid = rapid if line.rapid is None else line.rapid
        if inverse and not rapid and "F" not in line.words and set(line.words) & set(_AXES):
            line.wrong = line.wrong or "a feed move without F under inverse time (G93)"
        yield line


def _line(row: str, rules: Rules) -> Line:
    body = rules.comment.sub("", row).strip()
    if rules.call and rules.call.fullmatch(body):
        return Line(row, number=int(body[1 : body.index(" ")]))
    pairs = _WORD.findall(body)
    line = Line(row, wrong=_fault(body, pairs, rules))
    codes = [letter + value for letter, value in pairs]
    given = {letter.rstrip("="): value for letter, value in pairs if letter not in ("G", "M")}
    line.g = tuple(int(float(value)) for letter, value in pairs if letter == "G" and _is_number(value))
    line.m = tuple(int(float(value)) for letter, value in pairs if letter == "M" and _is_number(value))
    line.number = int(given["N"]) if given.get("N", "").isdecimal() else None
    line.words = {k: float(v) for k, v in given.items() if k in set("XYZABCFST") and _is_number(v)}
    line.rapid = True if "G0" in codes else False if "G1" in codes else None
    line.absolute = True if "G90" in codes else False if "G91" in codes else None
    line.compensation_off = "G40" in codes
    line.tcp = True if rules.tcp_on & set(codes) else False if rules.tcp_off & set(codes) else None
    line.machine_datum = bool(rules.datum_words & set(codes))
    if "G28" in codes:  # home, by way of where it stands
        line.lost = "".join(k for k in "XYZ" if k in line.words)
        line.words, line.machine_datum = {}, True
    if rules.vector and any(k in given for k in rules.vector):
        i, j, k = (float(given.get(name) or 0.0) for name in rules.vector)
        line.axis = (i, j, k)
    return line


def _fault(body: str, pairs: list[tuple[str, str]], rules: Rules) -> str:
    """What the control would say of the line's words."""
    if "".join(letter + value for letter, value in pairs) != body.replace(" ", ""):
        return "is no block of the control: it holds more than words"
    letters = [letter.rstrip("=") for letter, _ in pairs]
    for letter in letters:
        if letters.count(letter) > 1 and letter not in ("G", "M"):
            return f"has the word {letter} twice"
    for letter, value in pairs:
        fault = _word_fault(letter, value, rules)
        if fault:
            return fault
    return ""


def _word_fault(letter: str, value: str, rules: Rules) -> str:
    code, name = letter + value, letter.rstrip("=")
    if letter == "G":
        return "" if code in rules.g else f"{code} is not a word of this control"
    if letter == "M":
        return "" if value.isdecimal() and int(value) in rules.m else f"{code} is not a word of this control"
    if len(letter) > 1 and not letter.endswith("="):
        known = rules.keywords | rules.tcp_on | rules.tcp_off
        return "" if code in known else f"{code} is not a word of this control"
    if name not in _SINGLE and name not in (rules.vector or ()):
        return f"{code} is not a word of this control"
    if name in _AXES or name in (rules.vector or ()) or name in "FPQ":
        return "" if rules.axis_number.fullmatch(value) else f"{code}: its number is not one of this control"
    return "" if value.isdecimal() else f"{code}: must be a whole number"


def _is_number(value: str) -> bool:
    return re.fullmatch(r"[+-]?(?:\d+\.?\d*|\.\d+)", value) is not None
