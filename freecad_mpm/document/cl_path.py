"""The operation's neutral path: moves as commands `G1 X Y Z I J K F`, where I J K is the tool axis.

FreeCAD draws and stores such commands unchanged; A, B and C words it would turn. A comment `(cut, pass 3)` says what the
moves after it are for, so that a reopened document knows without computing."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import Path

from ..core.base import Floats, Integers

HEADING = re.compile(r"\((\w+), pass (-?\d+)\)")
RAPID = "rapid"
SECONDS_PER_MINUTE = 60.0
# Documents keep this many decimals: words rounded from the start give the same program before and after a save.
STORED_DECIMALS = 6
# command -> whether it is a rapid
MOVE_NAMES = {"G0": True, "G00": True, "G1": False, "G01": False}


@dataclass(frozen=True)
class StoredMoves:
    """M moves in machining order, part frame, mm."""

    kind: list[str]  # cut, link, rapid, plunge or retract
    pass_index: Integers  # (M,)
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3), unit, from the tip to the spindle
    feed_mm_per_min: Floats  # (M,); 0 for rapids

    def __len__(self) -> int:
        return len(self.kind)


@dataclass(frozen=True)
class Feeds:
    """Of the tool controller, mm/s as FreeCAD's commands have them."""

    horizontal: float
    vertical: float

    def of(self, kind: str) -> float:
        """mm/s of a kind of move: cuts and links at the horizontal feed, all others at the vertical one."""
        return self.horizontal if kind in ("cut", "link") else self.vertical


def to_commands(moves: Any, feeds: Feeds) -> list[Path.Command]:
    """`moves`: anything with the fields of StoredMoves, such as a plan's path."""
    commands, heading = [], None
    rows = np.round(np.column_stack((moves.tip, moves.axis)), STORED_DECIMALS).tolist()
    for kind, number, row in zip(map(str, moves.kind), map(int, moves.pass_index), rows):
        if heading != (kind, number):
            heading = (kind, number)
            commands.append(Path.Command(f"({kind}, pass {number})"))
        words = dict(zip("XYZIJK", row))
        if kind == RAPID:
            commands.append(Path.Command("G0", words))
        else:
            commands.append(Path.Command("G1", {**words, "F": round(feeds.of(kind), STORED_DECIMALS)}))
    return commands


def from_commands(commands: Iterable[Path.Command]) -> StoredMoves:
    """The moves of a path made by `to_commands`, after any number of saves. Raises ValueError for other motion."""
    kinds: list[str] = []
    passes: list[int] = []
    feeds: list[float] = []
    rows: list[list[float]] = []
    heading = (RAPID, -1)
    for command in commands:
        match = HEADING.fullmatch(command.Name)
        if match:
            heading = (match[1], int(match[2]))
        elif command.Name in MOVE_NAMES:
            rows.append(_words(command))
            feeds.append(command.Parameters.get("F", 0.0) * SECONDS_PER_MINUTE)
            kinds.append(RAPID if MOVE_NAMES[command.Name] else heading[0])
            passes.append(heading[1])
        elif not command.Name.startswith("("):
            raise ValueError(f"command {command.Name}: must be G0, G1 or a comment")
    table = np.array(rows).reshape(-1, 6)
    axis = table[:, 3:] / np.linalg.norm(table[:, 3:], axis=1, keepdims=True)  # stored with six decimals
    return StoredMoves(kinds, np.array(passes, dtype=int), table[:, :3], axis, np.array(feeds))


def _words(command: Path.Command) -> list[float]:
    words = command.Parameters
    missing = [letter for letter in "XYZIJK" if letter not in words]
    if missing:
        raise ValueError(f"command {command.toGCode()}: the words {' '.join(missing)} are missing")
    return [words[letter] for letter in "XYZIJK"]
