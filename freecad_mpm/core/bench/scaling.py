"""How `exact`'s time grows: with the number of positions and threads, the size of the surface, the tolerance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .. import job, part
from ..base import EXAMPLES, Floats, Progress, Stages
from ..job import Job
from ..part import FaceArrays
from .comparison import Row, Run, timed
from .summary import Table

SURFACE, METHOD = "saddle", "exact"
FEW, MANY = 10, 150  # passes; MANY squared is 22,500 positions
POLES = (312, 323)
COARSE_MM, FINE_MM = 1e-2, 1e-5
HEADINGS = (
    "what",
    "positions",
    "threads",
    "poles",
    "gouge tolerance, mm",
    "µs a position",
    "index, s",
    "cells",
    "times the base",
)


@dataclass(frozen=True)
class Case:
    """One measurement; `base` names the one that its time a position is compared with, by wall clock or processor."""

    name: str
    job: Job
    threads: int
    faces: Sequence[FaceArrays]
    base: str = ""
    clock: str = "cpu_microseconds_per_position"


def cases() -> list[Case]:
    """The thesis' saddle and its footprint; then one thing changed at a time."""
    spec = job.load(EXAMPLES / f"{SURFACE}.toml")
    spec = replace(spec, method=replace(spec.method, name=METHOD))
    one_patch = list(part.prepare(spec, None, Stages()).machined)
    refined = [refine(face, POLES) for face in one_patch]
    many = replace(
        spec,
        footprint=replace(spec.footprint, side_step_mm=150 / (MANY - 1), forward_step_mm=150 / (MANY - 1)),
    )
    coarse, fine = (
        replace(spec, tolerance=replace(spec.tolerance, gouge_mm=depth)) for depth in (COARSE_MM, FINE_MM)
    )
    wall = "microseconds_per_position"
    return [
        Case("thesis' footprint", spec, 1, one_patch),
        Case("22,500 positions", many, 1, one_patch, "thesis' footprint"),
        Case("two threads", many, 2, one_patch, "22,500 positions", wall),
        Case(f"{POLES[0]}×{POLES[1]} poles", spec, 1, refined, "thesis' footprint"),
        Case("coarse tolerance", coarse, 1, one_patch, "thesis' footprint"),
        Case("fine tolerance", fine, 1, one_patch, "coarse tolerance"),
    ]


def run(progress: Progress | None = None) -> list[Row]:
    """Measure all cases; each row is that of `bench.timed` with `case`, `poles`, `gouge_mm`, `base` and `ratio`."""
    rows: dict[str, Row] = {}
    for case in cases():
        stages = Stages(progress, threads=case.threads)
        scene = part.prepare(case.job, case.faces, stages)
        row, _ = timed(Run(SURFACE, case.job, case.threads), scene, stages)
        base = rows.get(case.base)
        rows[case.name] = row | {
            "case": case.name,
            "poles": " ".join(f"{one.poles.shape[0]}×{one.poles.shape[1]}" for one in case.faces),
            "gouge_mm": case.job.tolerance.gouge_mm,
            "base": case.base,
            "ratio": row[case.clock] / base[case.clock] if base else 1.0,
        }
    return list(rows.values())


def table(rows: Sequence[Row]) -> Table:
    """One row a measurement, in the order in which they were made."""
    return Table(HEADINGS, [_cells(row) for row in rows])


def _cells(row: Row) -> list[str]:
    base = f"{row['ratio']:.2f} ({row['base']})" if row["base"] else "1"
    return [
        row["case"],
        f"{row['positions']:,}",
        str(row["threads"]),
        row["poles"],
        f"{row['gouge_mm']:g}",
        f"{row['microseconds_per_position']:.0f}",
        f"{row['index_s']:.2f}",
        f"{row['cells_per_position']:.0f}",
        base,
    ]


def refine(face: FaceArrays, poles: tuple[int, int]) -> FaceArrays:
    """The same surface, a polynomial Bézier patch over the unit square, with knots inserted evenly for so many poles."""
    (ku, mu), (kv, mv) = (_insertion(d, n) for d, n in zip((face.degree_u, face.degree_v), poles))
    return replace(face, knots_u=ku, knots_v=kv, poles=np.einsum("ia,abc,jb->ijc", mu, face.poles, mv))


def _insertion(degree: int, count: int) -> tuple[Floats, Floats]:
    """Knots for `count` poles, and the matrix (count, degree + 1) from a Bézier curve's poles to the new ones: each new
    pole is the curve's polar form at `degree` neighbouring knots (Ramshaw 1989), by de Casteljau's steps."""
    inner = np.linspace(0.0, 1.0, count - degree + 1)
    knots = np.concatenate((np.zeros(degree), inner, np.ones(degree)))
    rows = []
    for i in range(count):
        polar = np.eye(degree + 1)
        for t in knots[i + 1 : i + 1 + degree]:
            polar = (1 - t) * polar[:-1] + t * polar[1:]
        rows.append(polar[0])
    return knots, np.array(rows)
