"""From what single lines say to blocks with the state that the control is in."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

from ..reader import AXES, NOWHERE, Block, State

Grammar = list[tuple[int | None, str, str]]  # block number, text, what is wrong
Vector = tuple[float, float, float]

SPINDLE_ON, SPINDLE_OFF = {3, 4, 13}, {2, 5, 30}
# A direction of seven decimals is a unit vector within this.
LENGTH_SLACK = 1e-6
NAN = float("nan")
LINE_ENDS = {"\r\n": "carriage return and line feed", "\n": "a line feed alone"}


@dataclass
class Line:
    """What one line says, in terms that all dialects share; None: nothing."""

    text: str
    number: int | None = None
    words: dict[str, float] = field(default_factory=dict)
    g: tuple[int, ...] = ()
    m: tuple[int, ...] = ()
    rapid: bool | None = None
    rapid_once: bool = False  # FMAX: in this block only
    absolute: bool | None = None
    compensation_off: bool = False
    tcp: bool | None = None
    tcp_ends: bool = False  # off from the next block on
    machine_datum: bool = False
    lost: str = ""  # axes sent to places that the program does not name
    axis: Vector | None = None
    wrong: str = ""


def blocks_of(lines: Iterable[Line]) -> tuple[list[Block], Grammar]:
    """Follow the state through all lines."""
    state, axis = State(), None
    blocks: list[Block] = []
    grammar: Grammar = []
    for line in lines:
        axis = _begin(state, line, axis)
        blocks.append(_block(state, line, axis))
        wrong = line.wrong or _vector_fault(line.axis)
        if wrong:
            grammar.append((line.number, line.text, wrong))
        if SPINDLE_OFF & set(line.m):
            state.spindle = False
        if line.tcp_ends:
            state.tcp = False
    return blocks, grammar


def _begin(state: State, line: Line, axis: Vector | None) -> Vector | None:
    """The state in the block; returns the tool's direction when it was given as a vector."""
    state.rapid = state.rapid if line.rapid is None else line.rapid
    state.absolute = state.absolute if line.absolute is None else line.absolute
    state.tcp = state.tcp if line.tcp is None else line.tcp
    state.compensation_off |= line.compensation_off
    state.spindle |= bool(SPINDLE_ON & set(line.m))
    state.feed = line.words.get("F", state.feed)
    turned = {letter for letter in "ABC" if letter in line.words}
    state.position = _position(state, line, bool(turned))
    state.linear = NOWHERE if state.tcp else _linear(state, line)
    if line.axis is not None:
        return line.axis
    return None if turned or line.tcp is not None else axis


def _position(state: State, line: Line, turned: bool) -> tuple[float, ...]:
    """Where the block ends, NaN where the text alone does not tell."""
    position = list(state.position)
    for k, letter in enumerate(AXES):
        if letter in line.words:
            unknown = line.machine_datum and letter in "XYZ"
            start = position[k] if state.absolute is False else 0.0
            position[k] = NAN if unknown else start + line.words[letter]
        if letter in line.lost:
            position[k] = NAN
    if line.axis is not None:  # the control finds the angles
        position[3:] = [NAN] * 3
    if turned and not state.tcp and position[3:] != list(state.position[3:]):
        position[:3] = [NAN] * 3  # the tip goes with the head, or the part with the table
    return tuple(position)


def _linear(state: State, line: Line) -> tuple[float, ...]:
    """Where the linear axes stand at the end of the block, of a control that does not hold the tip."""
    if not line.lost and not any(letter in line.words for letter in "XYZ"):
        return state.linear
    linear = list(state.linear)
    for k, letter in enumerate("XYZ"):
        if letter in line.words:
            start = linear[k] if state.absolute is False else 0.0
            linear[k] = NAN if line.machine_datum else start + line.words[letter]
        if letter in line.lost:
            linear[k] = NAN
    return tuple(linear)


def _block(state: State, line: Line, axis: Vector | None) -> Block:
    return Block(
        number=line.number,
        text=line.text,
        g=line.g,
        m=line.m,
        words=line.words,
        rapid=True if line.rapid_once else state.rapid,
        absolute=state.absolute,
        compensation_off=state.compensation_off,
        tcp=state.tcp,
        spindle=state.spindle,
        feed=state.feed,
        position=state.position,
        linear=state.linear,
        axis=axis,
        machine_datum=line.machine_datum,
    )


def _vector_fault(axis: Vector | None) -> str:
    if axis is None or abs(math.hypot(*axis) - 1.0) <= LENGTH_SLACK:
        return ""
    return f"the tool's direction must be a unit vector, its length is {math.hypot(*axis):.7f}"


def text_lines(text: str, line_end: str) -> tuple[list[str], Grammar]:
    """The lines, and what is wrong with the file as a whole."""
    wrong: Grammar = []
    if not text.isascii():
        wrong.append(
            (None, "", f"the file must be ASCII, it holds {next(c for c in text if not c.isascii())!r}")
        )
    ends = text.count(line_end)
    if (
        not text.endswith(line_end)
        or text.count("\n") != ends
        or text.count("\r") != ends * line_end.count("\r")
    ):
        wrong.append((None, "", f"every line must end in {LINE_ENDS[line_end]}"))
    return text.replace("\r\n", "\n").rstrip("\n").split("\n"), wrong


def rising_numbers(blocks: list[Block], step: int | None = None) -> Grammar:
    """Findings for numbers that do not rise; `step`: by exactly so much."""
    wrong: Grammar = []
    numbered = [block for block in blocks if block.number is not None]
    for before, block in zip(numbered, numbered[1:]):
        rise = (block.number or 0) - (before.number or 0)
        if rise <= 0 or (step and rise != step):
            wrong.append(
                (block.number, block.text, f"its number must follow the one before, {before.number}")
            )
    return wrong
