"""FreeCAD's own operations as moves of an upright tool: G0, G1, arcs in chords, and drilling cycles move by move."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..core.base import Floats, InputError, Names

SECONDS_PER_MINUTE = 60.0  # CAM's feeds are per second
ARC_TOLERANCE_MM = 0.002  # of a chord from its arc
UPRIGHT = (0.0, 0.0, 1.0)

# What has no meaning for the moves: planes, units, modes, datums, tool calls and spindle, which the post writes itself.
_IGNORED = frozenset(
    "G17 G20 G21 G40 G43 G49 G54 G55 G56 G57 G58 G59 G80 G90 G94 G98 G99 "
    "M0 M1 M3 M03 M4 M04 M5 M05 M6 M06 M7 M8 M9".split()
)


@dataclass(frozen=True)
class UprightMoves:
    """Moves of one operation: kind (M,) rapid or cut, tip (M, 3), feed (M,) mm/min. The tool stands along z."""

    kind: Names
    tip: Floats
    feed_mm_per_min: Floats

    @property
    def axis(self) -> Floats:
        """(M, 3): the set-up's z for all moves."""
        return np.tile(UPRIGHT, (len(self.kind), 1))


def moves_of(label: str, commands: Sequence[Any]) -> UprightMoves:
    """Of an operation's Path. Raises InputError that names the operation and what of it cannot be written."""
    run = _Run(label)
    for command in commands:
        run.follow(command.Name.upper(), dict(command.Parameters))
    if not run.rows:
        raise InputError(f"{label}: there are no moves to write; recompute it or deactivate it")
    if run.rows[0][0] != "rapid":
        raise InputError(f"{label}: must begin with a rapid move (G0) to a place clear of the part")
    kind, tip, feed = zip(*run.rows)
    return UprightMoves(np.array(kind), np.array(tip), np.array(feed))


@dataclass
class _Run:
    """Follows the commands; moves begin when X, Y and Z have all been told."""

    label: str
    at: list[float] = field(default_factory=lambda: [math.nan] * 3)
    feed: float = 0.0  # mm/min
    rows: list[tuple[str, list[float], float]] = field(default_factory=list)

    def follow(self, name: str, words: dict[str, float]) -> None:
        name = name.replace("G00", "G0").replace("G01", "G1").replace("G02", "G2").replace("G03", "G3")
        if name.startswith(("(", ";")) or name in _IGNORED:
            return
        handlers: dict[str, Callable[[dict[str, float]], None]] = {
            "G0": self._rapid,
            "G1": self._line,
            "G2": lambda one: self._arc(one, clockwise=True),
            "G3": lambda one: self._arc(one, clockwise=False),
            "G81": self._drill,
            "G83": self._peck,
            "G73": self._peck,
        }
        if name not in handlers:
            raise InputError(f"{self.label}: {name} cannot be written by the posts of this add-on")
        if set(words) & set("ABC"):
            raise InputError(
                f"{self.label}: {name} turns a rotary axis: only upright operations can be written"
            )
        handlers[name](words)

    def _rapid(self, words: dict[str, float]) -> None:
        self._go("rapid", self._end(words))

    def _line(self, words: dict[str, float]) -> None:
        self._set_feed(words)
        self._go("cut", self._end(words))

    def _arc(self, words: dict[str, float], clockwise: bool) -> None:
        self._set_feed(words)
        end, start = self._end(words), self.at
        for place in _chords(start, end, words.get("I", 0.0), words.get("J", 0.0), clockwise):
            self._go("cut", place)

    def _drill(self, words: dict[str, float]) -> None:
        self._set_feed(words)
        self._above_hole(words)
        self._go("cut", [*self.at[:2], words["Z"]])
        self._go("rapid", [*self.at[:2], words["R"]])

    def _peck(self, words: dict[str, float]) -> None:
        """Out of the hole after each step, and back to where it ended."""
        self._set_feed(words)
        self._above_hole(words)
        bottom, step = words["Z"], words.get("Q", 0.0)
        if step <= 0:
            raise InputError(f"{self.label}: a peck cycle needs a step Q of more than 0")
        for depth in _steps_down(words["R"], bottom, step):
            self._go("cut", [*self.at[:2], depth])
            self._go("rapid", [*self.at[:2], words["R"]])
            if depth > bottom:
                self._go("rapid", [*self.at[:2], depth])

    def _above_hole(self, words: dict[str, float]) -> None:
        x, y = words.get("X", self.at[0]), words.get("Y", self.at[1])
        self._go("rapid", [x, y, max(self.at[2], words["R"])])
        self._go("rapid", [x, y, words["R"]])

    def _end(self, words: dict[str, float]) -> list[float]:
        return [float(words.get(letter, now)) for letter, now in zip("XYZ", self.at)]

    def _set_feed(self, words: dict[str, float]) -> None:
        self.feed = words.get("F", self.feed / SECONDS_PER_MINUTE) * SECONDS_PER_MINUTE

    def _go(self, kind: str, end: list[float]) -> None:
        self.at = end
        if any(map(math.isnan, end)):
            return
        if kind == "cut" and not self.feed > 0:
            raise InputError(f"{self.label}: the feeds of its tool controller must be positive")
        if not self.rows or self.rows[-1][1] != end:
            self.rows.append((kind, end, self.feed))


def _chords(
    start: Sequence[float], end: Sequence[float], i: float, j: float, clockwise: bool
) -> Iterator[list[float]]:
    """Ends of chords along an arc or helix about start + (i, j), the last of them `end`; start and end alike: a full
    turn."""
    centre = start[0] + i, start[1] + j
    radius = math.hypot(i, j)
    first = math.atan2(-j, -i)
    turn = math.atan2(end[1] - centre[1], end[0] - centre[0]) - first
    turn = turn % (2 * math.pi) or 2 * math.pi
    if clockwise:
        turn = turn - 2 * math.pi or -2 * math.pi
    step = 2 * math.acos(1 - min(ARC_TOLERANCE_MM / radius, 1.0)) if radius > 0 else math.pi
    count = max(1, math.ceil(abs(turn) / step))
    for k in range(1, count):
        angle, s = first + turn * k / count, k / count
        z = start[2] + s * (end[2] - start[2])
        yield [centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle), z]
    yield list(end)


def _steps_down(top: float, bottom: float, step: float) -> Iterator[float]:
    count = max(1, math.ceil((top - bottom) / step - 1e-9))
    for k in range(1, count):
        yield top - k * step
    yield bottom
