"""The moves of a program's text, as its machine makes them: what the text does, not what its writer meant."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .. import machine as machines
from ..base import Floats, InputError, blame
from ..machine import Machine
from . import dialects, kinematics
from .reader import Motion, ParsedProgram

# Between two rows neither rotary axis turns more: the tool then leaves the great circle by less than 1e-4 degrees.
SAMPLE_TURN_DEG = 0.25


@dataclass(frozen=True)
class ProgramMoves:
    """M moves in the program's frame (the set-up's), mm."""

    kind: NDArray[np.str_]  # (M,): rapid, or cut for every feed move
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3)
    block: NDArray[np.int64]  # (M,): number of the block, -1 when it has none


def read_program(path: str, machine: str, dialect: str | None = None) -> ProgramMoves:
    """The moves of a program's file: forward kinematics of `machine`, rotary axes turning evenly within a block. Moves
    to places that the program gives in the machine's own frame only are left out, and the next one counts as a rapid.

    dialect: of dialects.READERS; None: the one it looks like. Raises InputError for files and names that there are
    not, and for a program without a move."""
    chain = machines.load(machine)
    try:
        text = Path(path).read_bytes().decode("latin-1")
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    with blame(f"{path}:"):
        moves = moves_of(dialects.read(text, dialect), chain)
    if not len(moves.kind):
        raise InputError(f"{path}: must have a move of the tool in the part's frame, found none")
    return moves


def moves_of(program: ParsedProgram, machine: Machine) -> ProgramMoves:
    """The moves of a parsed program."""
    motion = program.motion()
    angles = np.column_stack([motion.angles[letter] for letter in machine.rotary_letters])
    row, share = _steps(motion, angles)
    before = np.maximum(row - 1, 0)
    tip = _blend(motion.tip, before, row, share)
    axis = kinematics.tool_axes(machine, _blend(angles, before, row, share))
    given = _blend(motion.axis, before, row, share)
    with np.errstate(invalid="ignore"):
        given /= np.linalg.norm(given, axis=1, keepdims=True)
    axis = np.where(np.isnan(given), axis, given)
    known = motion.tcp[row] & np.isfinite(tip).all(axis=1) & np.isfinite(axis).all(axis=1)
    from_unknown = np.append(True, ~known[:-1])
    kind = np.where(motion.rapid[row] | from_unknown, "rapid", "cut")
    numbers = np.array(
        [-1 if block.number is None else block.number for block in program.blocks], dtype=np.int64
    )
    block = numbers[motion.block[row]] if len(row) else np.zeros(0, dtype=np.int64)
    return ProgramMoves(kind[known], tip[known], axis[known], block[known])


def _steps(motion: Motion, angles: Floats) -> tuple[NDArray[np.int64], Floats]:
    """Rows of `motion`, each as often as its turn takes, and how far along its move each step ends (0..1]."""
    turn = np.zeros(len(angles))
    turn[1:] = np.abs(np.diff(angles, axis=0)).max(axis=1)
    known = np.append(False, motion.tcp[1:] & motion.tcp[:-1]) & np.isfinite(turn)
    count = np.where(known, np.ceil(np.nan_to_num(turn) / SAMPLE_TURN_DEG), 1.0).astype(np.int64).clip(1)
    row = np.repeat(np.arange(len(count)), count)
    step = np.arange(len(row)) - np.repeat(np.cumsum(count) - count, count) + 1
    return row, np.asarray(step / count[row])


def _blend(values: Floats, before: NDArray[np.int64], row: NDArray[np.int64], share: Floats) -> Floats:
    """Evenly from the row before to the row; at the end exactly the row, whatever came before."""
    between = (1 - share)[:, None] * values[before] + share[:, None] * values[row]
    return np.asarray(np.where(share[:, None] == 1.0, values[row], between))
