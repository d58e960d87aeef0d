"""Programs read back from their text, as a control would: words, and the state they leave the machine in.

It knows the dialect from the control's manuals and shares nothing with the writers, so that it can find them wrong."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

AXES = "XYZABC"
CRLF = "\r\n"

_AXIS = r"[+-]\d{1,5}(?:\.\d{1,4})?"
_COUNT = r"\d{1,5}"
_RATE = r"\d{1,5}(?:\.\d{1,3})?"
_G_CODES = "00|01|17|30|31|40|90|91"
_M_CODES = "2|3|4|5|8|9|13|30|91|92|126|127|128|129"
_HEAD = re.compile(r"%([A-Z0-9_]+) G7[01] \*")
_END = re.compile(r"N(\d+) (%.*)")
_COMMENT = re.compile(r"N(\d+) ;[^*%;]*\*")
_TOOL = re.compile(rf"N(\d+) T{_COUNT} G17 S{_RATE} \*")
_MOTION = re.compile(
    rf"N(\d+)(?: G(?:{_G_CODES}))*"
    + "".join(rf"(?: {axis}{_AXIS})?" for axis in AXES)
    + rf"(?: F{_RATE})?(?: S{_RATE})?(?: T{_COUNT})?(?: M(?:{_M_CODES}))* \*"
)
_WORD = re.compile(r"([A-Z])([+-]?\d+(?:\.\d*)?)")
_NUMBER = re.compile(r"N(\d+)")


@dataclass(slots=True)
class State:
    """What earlier blocks have set. Positions are NaN until the program says where the machine is."""

    rapid: bool | None = None
    absolute: bool | None = None
    compensation_off: bool = False
    tcp: bool = False  # M128: X Y Z are the tip in the part's frame, whatever the rotary axes do
    spindle: bool = False
    rpm: float = 0.0
    feed: float = 0.0
    position: tuple[float, ...] = (float("nan"),) * len(AXES)


@dataclass(frozen=True, slots=True)
class Block:
    """One line. Flags and values are those at work in it; `position` is where it ends, X Y Z A B C."""

    number: int | None
    text: str
    g: tuple[int, ...]
    m: tuple[int, ...]
    words: dict[str, float]
    rapid: bool | None
    absolute: bool | None
    compensation_off: bool
    tcp: bool
    spindle: bool
    feed: float
    position: tuple[float, ...]
    axis: tuple[
        float, float, float
    ] | None = None  # the tool's direction, where the text gives it as a vector
    at_machine_datum: bool = False  # as M91, in the words of other dialects

    @property
    def moves(self) -> bool:
        """Whether an axis is told to go somewhere."""
        return not (30 in self.g or 31 in self.g) and any(axis in self.words for axis in AXES)

    @property
    def machine_datum(self) -> bool:
        """M91, M92: coordinates of the machine's own datum, not of the part."""
        return 91 in self.m or 92 in self.m or self.at_machine_datum


@dataclass(frozen=True)
class Motion:
    """The K blocks that move, as arrays."""

    block: NDArray[np.int64]  # (K,) index into ParsedProgram.blocks
    rapid: NDArray[np.bool_]
    tcp: NDArray[np.bool_]
    feed: Floats  # (K,) mm/min in force
    tip: Floats  # (K, 3) X Y Z at the end of the block; NaN: not known in the part's frame
    angles: dict[str, Floats]  # A, B, C: (K,) degrees, NaN: never set
    axis: Floats  # (K, 3) where the text gives the tool's direction as a vector, else NaN


@dataclass(frozen=True)
class ParsedProgram:
    name: str
    blocks: list[Block]
    grammar: list[tuple[int | None, str, str]] = field(
        default_factory=list
    )  # block number, text, what is wrong

    def motion(self) -> Motion:
        """All blocks that move and their end positions."""
        rows = [i for i, block in enumerate(self.blocks) if block.moves]
        blocks = [self.blocks[i] for i in rows]
        positions = np.array([b.position for b in blocks]).reshape(len(blocks), len(AXES))
        return Motion(
            block=np.array(rows, dtype=np.int64),
            rapid=np.array([b.rapid is True for b in blocks], dtype=bool),
            tcp=np.array([b.tcp for b in blocks], dtype=bool),
            feed=np.array([b.feed for b in blocks], dtype=float),
            tip=positions[:, :3],
            angles={letter: positions[:, 3 + k] for k, letter in enumerate("ABC")},
            axis=np.array([b.axis or (float("nan"),) * 3 for b in blocks]).reshape(len(blocks), 3),
        )


def read(text: str) -> ParsedProgram:
    """Parse a DIN/ISO program. Lines that break the grammar are listed and read as far as they can be."""
    grammar = _check_file(text)
    lines = text.replace(CRLF, "\n").split("\n")
    while lines and not lines[-1]:
        lines.pop()
    state, blocks = State(), []
    for line in lines[1:-1]:
        block, wrong = _read_block(line, state)
        blocks.append(block)
        if wrong:
            grammar.append((block.number, line, wrong))
    grammar += _check_numbers(lines, blocks)
    head = _HEAD.fullmatch(lines[0]) if lines else None
    return ParsedProgram(head[1] if head else "", blocks, grammar)


def _read_block(line: str, state: State) -> tuple[Block, str]:
    """The block of a line and what is wrong with its grammar; `state` goes on to what the block leaves."""
    match = _MOTION.fullmatch(line) or _COMMENT.fullmatch(line) or _TOOL.fullmatch(line)
    wrong = "" if match else "is no block of the control: words, their order or their numbers"
    words = [] if ";" in line else _WORD.findall(line)
    values = {letter: float(value) for letter, value in words if letter not in "GMN"}
    g = tuple(int(float(value)) for letter, value in words if letter == "G")
    m = tuple(int(float(value)) for letter, value in words if letter == "M")
    number = _NUMBER.match(line)
    _begin(state, g, m, values)
    block = Block(
        number=int(number[1]) if number else None,
        text=line,
        g=g,
        m=m,
        words=values,
        rapid=state.rapid,
        absolute=state.absolute,
        compensation_off=state.compensation_off,
        tcp=state.tcp,
        spindle=state.spindle,
        feed=state.feed,
        position=state.position,
    )
    _end(state, m)
    return block, wrong


def _begin(state: State, g: tuple[int, ...], m: tuple[int, ...], values: dict[str, float]) -> None:
    """What takes effect at the start of a block, and its move."""
    for code in g:
        if code in (0, 1):
            state.rapid = code == 0
        elif code in (90, 91):
            state.absolute = code == 90
        elif code == 40:
            state.compensation_off = True
    if 128 in m:
        state.tcp = True
    if 3 in m or 4 in m or 13 in m:
        state.spindle = True
    state.feed = values.get("F", state.feed)
    state.rpm = values.get("S", state.rpm)
    if values and 30 not in g and 31 not in g:
        state.position = _moved(state, values, 91 in m or 92 in m)


def _moved(state: State, values: dict[str, float], machine_datum: bool) -> tuple[float, ...]:
    """Where the block ends; a linear axis sent to a place of the machine's own is nowhere in the part."""
    position = list(state.position)
    for k, axis in enumerate(AXES):
        if axis in values:
            lost = machine_datum and axis in "XYZ"
            start = 0.0 if state.absolute is not False else position[k]
            position[k] = float("nan") if lost else start + values[axis]
    turned = any(position[k] != state.position[k] for k in (3, 4, 5) if AXES[k] in values)
    if turned and not state.tcp:  # the tip goes with the head, or the part with the table
        position[:3] = [float("nan")] * 3
    return tuple(position)


def _end(state: State, m: tuple[int, ...]) -> None:
    """What takes effect at the end of a block."""
    if 129 in m:
        state.tcp = False
    if 5 in m or 30 in m or 2 in m:
        state.spindle = False


def _check_file(text: str) -> list[tuple[int | None, str, str]]:
    wrong: list[tuple[int | None, str, str]] = []
    if not text.isascii():
        first = next(c for c in text if not c.isascii())
        wrong.append((None, "", f"the file must be ASCII, it holds {first!r}"))
    if (
        text.count("\n") != text.count(CRLF)
        or text.count("\r") != text.count(CRLF)
        or not text.endswith(CRLF)
    ):
        wrong.append((None, "", "every line must end in carriage return and line feed"))
    lines = text.split(CRLF)[:-1]
    head = _HEAD.fullmatch(lines[0]) if lines else None
    if not head:
        return wrong + [(None, lines[0] if lines else "", "the first line must be %NAME G71 *")]
    end = _END.fullmatch(lines[-1])
    if not end or end[2] != lines[0]:
        wrong.append((None, lines[-1], f"the last line must repeat {lines[0]} with the end block's number"))
    return wrong


def _check_numbers(lines: list[str], blocks: list[Block]) -> list[tuple[int | None, str, str]]:
    """Block numbers rise strictly up to the end block's; there is a whole blank form or none."""
    wrong: list[tuple[int | None, str, str]] = []
    end = _END.fullmatch(lines[-1]) if lines else None
    limit = int(end[1]) if end else None
    last = 0
    for block in blocks:
        number = block.number if block.number is not None else last
        if block.number is not None and number <= last:
            wrong.append((number, block.text, f"its number must be more than the one before, N{last}"))
        last = max(last, number)
    if limit is not None and last >= limit:
        wrong.append((last, "", f"its number must be less than the end block's, N{limit}"))
    forms = [code for block in blocks for code in block.g if code in (30, 31)]
    if forms not in ([], [30, 31]):
        wrong.append((None, "", "the blank form must be one G30 followed by one G31, or be left out"))
    return wrong
