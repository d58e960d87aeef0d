"""A program's file checked from its text alone, against a machine and, where it is given, a CL file."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .. import machine as machines
from .. import posts
from ..base import Floats, InputError, blame
from ..control import CheckResult, Control, ParsedProgram, check_program, dialects
from ..path import read_csv

LISTED_FINDINGS = 10
CHECKS = ("grammar", "state", "round trip", "limits", "continuity", "straightness")


@dataclass(frozen=True)
class Checked:
    """A program that was read, what the checks found, and whether a CL file was among them."""

    program: ParsedProgram
    result: CheckResult
    compared: bool  # with a CL file

    @property
    def good(self) -> bool:
        """No finding: the machine will do nothing that the checks object to."""
        return self.result.good

    @property
    def lines(self) -> list[str]:
        """What was found, for people: one line a check, then the first findings."""
        findings = self.result.findings
        shown = [f"  {one}" for one in findings[:LISTED_FINDINGS]]
        more = len(findings) - len(shown)
        return [
            f"Program {self.program.name}: {len(self.program.blocks)} blocks",
            *(f"{check}: {self._outcome(check)}" for check in CHECKS),
            *shown,
            *([f"  and {more} more"] if more else []),
        ]

    def _outcome(self, check: str) -> str:
        if check == "round trip" and not self.compared:
            return "not made, no CL file was given"
        count = sum(one.check == check for one in self.result.findings)
        outcome = f"{count} findings" if count else "passed"
        if check == "straightness":
            tip, axis = self.result.tip_between_mm, self.result.axis_between_deg
            return f"{outcome}, tip off its line <= {tip:.6f} mm, axis off its great circle <= {axis:.6f} deg"
        if check != "round trip":
            return outcome
        tip, axis = self.result.tip_error_mm, self.result.axis_error_deg
        return f"{outcome}, tip error <= {tip:.6f} mm, axis error <= {axis:.6f} deg"


def check_file(
    program: str, machine: str, post: str | None = None, against: str | None = None, tcp: bool = True
) -> Checked:
    """All checks of a program's file; post None: the dialect that the text looks like; against: a cl.csv in the frame of
    the program; tcp: the control holds the tip. Raises InputError for files, machines and posts that there are not.
    """
    control = Control(tcp)
    chain = machines.load(machine)
    dialect = None if post is None else posts.load(post).dialect
    text = _text(program)
    with blame(f"{program}:"):
        parsed = dialects.read(text, dialect)
    if against is None:
        return Checked(parsed, check_program(parsed, chain, control=control), compared=False)
    moves = read_csv(against)
    tip, axis = _without_repeats(moves.tip, moves.axis)
    return Checked(parsed, check_program(parsed, chain, tip, axis, control), compared=True)


def _text(path: str) -> str:
    try:
        return Path(path).read_bytes().decode("latin-1")  # every byte is a letter: the checks want ASCII
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None


def _without_repeats(tip: Floats, axis: Floats) -> tuple[Floats, Floats]:
    """A cl.csv has a pose twice where a plunge ends in a position; the program goes there once."""
    pose = np.hstack((tip, axis))
    new = np.append(True, np.any(np.diff(pose, axis=0) != 0, axis=1))
    return tip[new], axis[new]
