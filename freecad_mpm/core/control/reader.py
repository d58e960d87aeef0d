"""What a program read back from its text is: blocks, each with the state that its control is in (read by dialects/)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..base import Floats

AXES = "XYZABC"
NOWHERE = (float("nan"),) * 3


@dataclass(slots=True)
class State:
    """What earlier blocks have set. Positions are NaN until the program says where the machine is."""

    rapid: bool | None = None
    absolute: bool | None = None
    compensation_off: bool = False
    tcp: bool = False  # M128: X Y Z are the tip in the part's frame, whatever the rotary axes do
    spindle: bool = False
    feed: float = 0.0
    position: tuple[float, ...] = NOWHERE * 2  # X Y Z of the tip in the part's frame, A B C
    linear: tuple[
        float, ...
    ] = NOWHERE  # X Y Z of the linear axes less datum and tool length; not known under TCP


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
    linear: tuple[float, ...] = NOWHERE  # where the linear axes stand at its end
    axis: tuple[
        float, float, float
    ] | None = None  # the tool's direction, where the text gives it as a vector
    machine_datum: bool = False  # coordinates of the machine's own datum (M91, G53), not of the part

    @property
    def moves(self) -> bool:
        """Whether an axis is told to go somewhere."""
        return any(axis in self.words for axis in AXES)


@dataclass(frozen=True)
class Motion:
    """The K blocks that move, as arrays."""

    block: NDArray[np.int64]  # (K,) index into ParsedProgram.blocks
    rapid: NDArray[np.bool_]
    tcp: NDArray[np.bool_]
    feed: Floats  # (K,) mm/min in force
    tip: Floats  # (K, 3) X Y Z at the end of the block; NaN: not known in the part's frame
    linear: Floats  # (K, 3) X Y Z of the linear axes there, less datum and tool length; NaN: not known
    angles: dict[str, Floats]  # A, B, C: (K,) degrees, NaN: never set
    axis: Floats  # (K, 3) where the text gives the tool's direction as a vector, else NaN


@dataclass(frozen=True)
class ParsedProgram:
    """A program as its control reads it, the wrong places included: they end no reading."""

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
            linear=np.array([b.linear for b in blocks]).reshape(len(blocks), 3),
            angles={letter: positions[:, 3 + k] for k, letter in enumerate("ABC")},
            axis=np.array([b.axis or NOWHERE for b in blocks]).reshape(len(blocks), 3),
        )
