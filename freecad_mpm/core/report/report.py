"""The report of a plan: what was done and how good it is, as data; words and JSON are made of it at the edge."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ...version import __version__
from ..job import Job, Tolerance, cut_depth_mm
from ..machine import Machine
from ..path import ToolPath
from ..positioning import Positions, spacing
from ..program import Made, ProgramReport
from ..removal import Cut, CutReport
from .figures import PathFigures, PositionFigures, TimeFigures, WorstPosition
from .statement import statement
from .verdict import Verdict
from .warnings import slowed, unproven, warnings

Facts = dict[str, Any]


@dataclass(frozen=True)
class ProgramFigures:
    """The program's file and figures; of how many of the machine's moves it cannot do one."""

    file: str
    report: ProgramReport
    moves: int
    moves_beyond_machine: int


@dataclass(frozen=True)
class Report:
    """All that is told of a plan; lengths in mm, places in the part's frame."""

    verdict: Verdict
    warnings: tuple[str, ...]
    job: Facts  # every key of every table, and where the job came from
    positions: PositionFigures
    worst_position: WorstPosition | None
    path: PathFigures
    program: ProgramFigures
    work: Mapping[str, float]  # the method's counters, altogether and a position
    time: TimeFigures
    statement: str
    contact_spacing: spacing.KeptSpacing | None = None  # None: the job wants none
    cut: CutReport | None = None  # None: not cut into stock
    version: str = __version__


def make_report(
    job: Job,
    machine: Machine,
    positions: Positions,
    path: ToolPath,
    made: Made,
    verdict: Verdict,
    counters: Mapping[str, int],
    seconds: Mapping[str, float],
    contact_spacing: spacing.KeptSpacing | None,
) -> Report:
    """positions and path in the part's frame; seconds: stage -> wall time, s."""
    tolerance, guarantee, (part,) = job.tolerance, verdict.guarantee, made.parts
    return Report(
        verdict=verdict,
        warnings=(
            *warnings(job, machine, positions, path, guarantee),
            *unproven(path),
            *slowed(machine, path, part.joints),
        ),
        job=asdict(job),
        positions=PositionFigures.of(positions, tolerance, guarantee),
        worst_position=WorstPosition.of(positions),
        path=PathFigures.of(positions, path, tolerance, guarantee),
        program=ProgramFigures(
            made.program.file_name,
            made.report,
            len(part.joints),
            int(np.count_nonzero(part.joints.status != "ok")),
        ),
        work={**counters, **{f"{name}_per_position": n / len(positions) for name, n in counters.items()}},
        time=TimeFigures.of(seconds, positions),
        statement=statement(positions, path, tolerance, guarantee),
        contact_spacing=contact_spacing,
    )


def with_cut(plain: Report, tolerance: Tolerance, cut: Cut) -> Report:
    """The report with what the removal, which knows nothing of the method, found of the plan's path; a face that it
    finds cut deeper than the tolerances allow makes the plan bad."""
    verdict = plain.verdict
    depth = cut_depth_mm(tolerance, verdict.guarantee)
    if not cut.good(depth):
        verdict = verdict.with_trouble(f"the removal finds a face cut deeper than {depth:g} mm")
    return replace(plain, verdict=verdict, cut=CutReport.of(cut))
