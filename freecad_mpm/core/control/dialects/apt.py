"""APT cutter locations."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..reader import ParsedProgram
from .state import Grammar, Line, blocks_of, text_lines

_NUMBER = r"-?\d+\.\d*"
_GOTO = re.compile(rf"GOTO/({_NUMBER}(?:,{_NUMBER}){{5}})")
_FEED = re.compile(rf"FEDRAT/MMPM,({_NUMBER})")
_TOOL = re.compile(r"LOADTL/(\d+)")
_SPINDLE = re.compile(r"SPINDL/(?:RPM,\d+,CLW|OFF)")
_OTHER = re.compile(r"PARTNO/\w+|PPRINT/.*|UNITS/MM|MULTAX/ON|COOLNT/(?:ON|OFF)|RAPID|STOP|FINI")


def read(text: str) -> ParsedProgram:
    """Parse APT statements; RAPID holds for the next GOTO only."""
    rows, grammar = text_lines(text, "\n")
    head = re.fullmatch(r"PARTNO/(\w+)", rows[0])
    blocks, wrong = blocks_of(_lines(rows))
    return ParsedProgram(head[1] if head else "", blocks, grammar + wrong + _file_faults(rows))


def _file_faults(rows: list[str]) -> Grammar:
    wrong: Grammar = []
    if not rows[0].startswith("PARTNO/"):
        wrong.append((None, rows[0], "the first statement must be PARTNO/NAME"))
    if rows[-1] != "FINI":
        wrong.append((None, rows[-1], "the last statement must be FINI"))
    wrong += [(None, "", f"{word} is missing") for word in ("UNITS/MM", "MULTAX/ON") if word not in rows]
    return wrong


def _lines(rows: list[str]) -> Iterator[Line]:
    rapid = False
    for row in rows:
        line = Line(row, absolute=True, compensation_off=True)
        goto, feed, tool = _GOTO.fullmatch(row), _FEED.fullmatch(row), _TOOL.fullmatch(row)
        if goto:
            x, y, z, i, j, k = (float(value) for value in goto[1].split(","))
            line.words, line.axis, line.rapid = {"X": x, "Y": y, "Z": z}, (i, j, k), rapid
            line.tcp = True  # a cutter location is the tip by definition
        elif feed:
            line.words = {"F": float(feed[1])}
        elif tool:
            line.words, line.tcp = {"T": float(tool[1])}, False
        elif _SPINDLE.fullmatch(row):
            line.m = (5,) if row.endswith("OFF") else (3,)
        elif not _OTHER.fullmatch(row):
            line.wrong = "is no statement that is known here"
        line.tcp = False if row == "FINI" else line.tcp
        rapid = row == "RAPID"
        yield line
