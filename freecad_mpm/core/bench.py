"""The comparison of methods: the same jobs by each method, with one thread and with all."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from . import job, planning
from .errors import InputError
from .job import Job
from .resources import EXAMPLES
from .sections import suggestion
from .stages import Progress

# Thesis table 1.
DEFAULT_SURFACES = ("convex", "concave", "saddle")

# Key of a row -> heading of its column.
COLUMNS = {
    "method": "method",
    "surface": "surface",
    "threads": "threads",
    "positions": "positions",
    "positions_per_second": "positions/s",
    "evaluations_per_position": "evaluations/position",
    "cells_per_position": "cells/position",
    "seeds_per_position": "seeds/position",
    "newton_steps_per_position": "Newton steps/position",
    "two_contacts": "two contacts",
    "left_out": "left out",
    "worst_clearance_mm": "worst clearance, mm",
    "deep_clearance_mm": "99.9 % above, mm",
}
# Of the usable positions this percentage is clearer than deep_clearance_mm.
DEEP_PERCENT = 99.9
STAGES = "time per stage, s"

Row = dict[str, Any]


@dataclass(frozen=True)
class Run:
    """One measurement."""

    surface: str
    job: Job
    threads: int


def runs(surfaces: Sequence[str] | None, methods: Sequence[str] | None, threads: int) -> list[Run]:
    """Every surface by every method (None: all); threads 0: with one thread, and with all cores.

    Raises InputError for a surface that is neither a shipped example nor a job file, and an unknown method.
    """
    counts = [threads] if threads else sorted({1, os.cpu_count() or 1})
    jobs = {Path(name).stem: job.load(_job_file(name)) for name in surfaces or DEFAULT_SURFACES}
    result = []
    for method in methods or planning.method_names():
        for surface, spec in jobs.items():
            with_method = replace(
                spec, method=replace(spec.method, name=method, options={}), source="--methods"
            )
            planning.check_method(with_method)
            result += [Run(surface, replace(with_method, source=spec.source), count) for count in counts]
    return result


def _job_file(name: str) -> Path:
    examples = sorted(path.stem for path in EXAMPLES.glob("*.toml"))
    if name in examples:
        return EXAMPLES / f"{name}.toml"
    if Path(name).is_file():
        return Path(name)
    raise InputError(
        f"--surfaces: '{name}' is no job file and no shipped example{suggestion(name, examples)}"
    )


def measure(run: Run, on_progress: Progress | None = None) -> Row:
    """Compute the plan of one run and take its figures."""
    plan = planning.plan(run.job, on_progress=on_progress, threads=run.threads)
    facts = plan.report
    clearance = plan.clearance[plan.usable, 1]
    positions, worst = facts["positions"], facts["worst_position"]
    return {
        "method": run.job.method.name,
        "surface": run.surface,
        "threads": run.threads,
        "positions": positions["count"],
        "positions_per_second": facts["time"]["positions_per_second"],
        "evaluations_per_position": facts["work"]["evaluations_per_position"],
        "cells_per_position": facts["work"]["cells_per_position"],
        "seeds_per_position": facts["work"]["seeds_per_position"],
        "newton_steps_per_position": facts["work"]["newton_steps_per_position"],
        "two_contacts": positions["statuses"].get("two_contacts", 0) / positions["count"],
        "left_out": positions["left_out"],
        "statuses": positions["statuses"],
        "gouging": positions["gouging"],
        "worst_clearance_mm": worst and worst["clearance_mm"],
        "deep_clearance_mm": float(np.percentile(clearance, 100 - DEEP_PERCENT)) if len(clearance) else None,
        "guarantee": positions["guarantee"],
        "stages_s": facts["time"]["stages_s"],
    }


def to_json(rows: Sequence[Row]) -> str:
    return json.dumps({"rows": list(rows)}, indent=2, allow_nan=False) + "\n"


def to_csv(rows: Sequence[Row]) -> str:
    """One line a row, the keys of bench.json as heads; the statuses as name=count and the stages as name=seconds."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    if rows:
        writer.writerow(rows[0])
    writer.writerows([_csv_value(value) for value in row.values()] for row in rows)
    return text.getvalue()


def _csv_value(value: Any) -> Any:
    return " ".join(f"{name}={part}" for name, part in value.items()) if isinstance(value, dict) else value


def table(rows: Sequence[Row]) -> str:
    """The rows for people, in columns."""
    cells = [(*COLUMNS.values(), STAGES), *map(_cells, rows)]
    widths = [max(map(len, column)) for column in zip(*cells)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in cells
    )


def _cells(row: Row) -> tuple[str, ...]:
    stages = ", ".join(f"{stage} {seconds:.2f}" for stage, seconds in row["stages_s"].items())
    return (*(_cell(row[name]) for name in COLUMNS), stages)


def _cell(value: Any) -> str:
    """Large numbers whole, small ones to the nanometre."""
    if not isinstance(value, float):
        return "none" if value is None else str(value)
    return f"{value:.0f}" if abs(value) >= 1 else f"{value:.6f}"
