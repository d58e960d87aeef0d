"""The cutter-location file cl.csv, written and read.

Part frame, mm, nine decimals; rows in machining order. Every position on the path is one row of kind cut, whose `index`
counts the positions of its pass from 0. All other rows have index -1 and no status, contacts, angles or clearances: the
plunge to the first position of a pass stands in a row of its own before it."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..base import Flags, Floats, InputError, Integers, Names
from ..positioning import Positions
from .tool_path import ToolPath

HEADER = (
    "pass,index,kind,status,tip_x,tip_y,tip_z,axis_x,axis_y,axis_z,p_x,p_y,p_z,q_x,q_y,q_z,tilt_deg,spin_deg,"
    "clearance_lo_mm,clearance_hi_mm"
)
KINDS = ("cut", "link", "rapid", "plunge", "retract")
POSE_COLUMNS = ("tip_x", "tip_y", "tip_z", "axis_x", "axis_y", "axis_z")
DECIMALS = 9
NO_POSITION = -1  # index of a row that ends in none

# An axis read from a file may differ from unit length by this much; it is then normalised.
AXIS_LENGTH_SLACK = 1e-3


def to_csv(positions: Positions, path: ToolPath) -> str:
    """The text of cl.csv for a path over positions, both in the part's frame."""
    kind, position, row_of = _rows(path)
    columns = (path.pass_index[row_of].tolist(), _index_in_pass(positions)[position].tolist(), kind.tolist())
    status = np.append(positions.status, "")[position].tolist()
    poses = _texts(np.hstack((path.tip, path.axis))[row_of])
    details = _texts(_details(positions)[position])
    rows = zip(*columns, status, poses, details)
    return "\n".join([HEADER, *(",".join(map(str, row)) for row in rows), ""])


def _rows(path: ToolPath) -> tuple[Names, Integers, Integers]:
    """Kind, position and move of every row: a plunge that ends in a position becomes two, the plunge and a cut."""
    arrives = (path.kind != "cut") & (path.position >= 0)
    row_of = np.repeat(np.arange(len(path)), 1 + arrives)
    is_arrival = np.append(row_of[1:] == row_of[:-1], False)  # the first of two rows
    kind, position = path.kind[row_of], path.position[row_of]
    return (
        np.where(position >= 0, np.where(is_arrival, kind, "cut"), kind),
        np.where(is_arrival, -1, position),
        row_of,
    )


def _index_in_pass(positions: Positions) -> Integers:
    """(N + 1,): of each position within its pass; the last entry, -1, is what index -1 finds."""
    passes = positions.pass_index
    first = np.searchsorted(passes, passes)  # non-decreasing: where each position's pass begins
    return np.append(np.arange(len(passes)) - first, -1)


def _details(positions: Positions) -> Floats:
    """(N + 1, 10): contacts, tilt, spin and clearance of each position; the last row, NaN, is what index -1 finds."""
    angles = np.column_stack((positions.tilt_deg, positions.spin_deg))
    table = np.hstack((positions.contacts.reshape(-1, 6), angles, positions.clearance))
    return np.vstack((table, np.full((1, table.shape[1]), np.nan)))


def _texts(table: Floats) -> list[str]:
    """Each row as comma-separated numbers; NaN becomes empty and -0 becomes 0."""
    rounded = np.round(table, DECIMALS) + 0.0
    template = ",".join([f"%.{DECIMALS}f"] * table.shape[1])
    texts = [template % tuple(row) for row in rounded.tolist()]
    for i in np.flatnonzero(np.isnan(rounded).any(axis=1)).tolist():
        texts[i] = texts[i].replace("nan", "")
    return texts


@dataclass(frozen=True)
class ClMoves:
    """M moves read from a file, part frame, mm."""

    kind: Names  # (M,)
    pass_index: Integers  # (M,), 0 when the file has no such column
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3), unit
    line: Integers  # (M,), of the file, from 1
    between: Flags  # (M,), a cut that ends between two positions: kind cut, index -1

    def __len__(self) -> int:
        return len(self.kind)


def read_csv(path: str | Path) -> ClMoves:
    """The moves of a cl.csv, ours or not: columns in any order; only the tip and the axis must be there.

    Raises InputError that names the file and the line, what is wrong and what would be right."""
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            rows = [(number, row) for number, row in enumerate(csv.reader(file), 1) if any(row)]
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror or error}") from None
    except (UnicodeDecodeError, csv.Error):
        raise InputError(f"{path}: must be a CSV text in UTF-8") from None
    if len(rows) < 2:
        raise InputError(f"{path}: must have a header line and at least one move")
    return _Reader(str(path), [name.strip() for name in rows[0][1]], rows[1:]).moves()


class _Reader:
    """The rows of one file below its header."""

    def __init__(self, path: str, names: list[str], rows: list[tuple[int, list[str]]]) -> None:
        self._path, self._names, self._rows = path, names, rows
        missing = [name for name in POSE_COLUMNS if name not in names]
        if missing:
            raise InputError(f"{path}:1: the header must have the column {missing[0]}, got {','.join(names)}")
        for line, row in rows:
            if len(row) != len(names):
                raise InputError(
                    f"{path}:{line}: must have {len(names)} columns like the header, got {len(row)}"
                )

    def moves(self) -> ClMoves:
        poses = np.column_stack([self._numbers(name) for name in POSE_COLUMNS])
        lengths = np.linalg.norm(poses[:, 3:], axis=1)
        for i in np.flatnonzero(np.abs(lengths - 1) > AXIS_LENGTH_SLACK)[:1]:
            raise self._error(int(i), f"the axis must have length 1, got {lengths[i]:.6g}")
        return ClMoves(
            kind=self._kinds(),
            pass_index=self._passes(),
            tip=poses[:, :3],
            axis=poses[:, 3:] / lengths[:, None],
            line=np.array([line for line, _ in self._rows]),
            between=self._between(),
        )

    def _column(self, name: str) -> list[str]:
        at = self._names.index(name)
        return [row[at].strip() for _, row in self._rows]

    def _numbers(self, name: str) -> Floats:
        cells = self._column(name)
        result = np.array([_number(cell) for cell in cells])
        for i in np.flatnonzero(~np.isfinite(result))[:1]:
            raise self._error(int(i), f"{name} must be a finite number, got '{cells[i]}'")
        return result

    def _kinds(self) -> Names:
        cells = self._column("kind") if "kind" in self._names else ["cut"] * len(self._rows)
        for i, cell in enumerate(cells):
            if cell not in KINDS:
                raise self._error(i, f"kind must be one of {', '.join(KINDS)}, got '{cell}'")
        return np.array(cells)

    def _passes(self) -> Integers:
        if "pass" not in self._names:
            return np.zeros(len(self._rows), dtype=np.int64)
        return self._numbers("pass").astype(np.int64)

    def _between(self) -> Flags:
        if "index" not in self._names:
            return np.zeros(len(self._rows), dtype=bool)
        return np.asarray((self._numbers("index") == NO_POSITION) & (self._kinds() == "cut"))

    def _error(self, row: int, message: str) -> InputError:
        return InputError(f"{self._path}:{self._rows[row][0]}: {message}")


def _number(cell: str) -> float:
    try:
        return float(cell)
    except ValueError:
        return float("nan")
