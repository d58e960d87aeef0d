"""The comparison of methods: the same jobs by each method, with one thread and with all."""

from __future__ import annotations

import csv
import io
import json
import os
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from ... import _core
from .. import job
from ..base import EXAMPLES, Floats, InputError, Progress, Stages, suggestion
from ..job import Job
from ..part import Scene, prepare
from ..positioning import (
    Positions,
    as_positions,
    check_method,
    guarantee_of,
    lay_out,
    make_positioner,
    method_names,
)

# Thesis table 1.
DEFAULT_SURFACES = ("convex", "concave", "saddle")
# Seconds until which a run is repeated, so often at most: the least time counts, the rest is other programs'.
REPEATED_S = 0.5
MOST_REPEATS = 10

# Key of a row -> heading of its column.
COLUMNS = {
    "method": "method",
    "surface": "surface",
    "threads": "threads",
    "positions": "positions",
    "microseconds_per_position": "µs/position",
    "cpu_microseconds_per_position": "processor's",
    "index_s": "index, s",
    "evaluations_per_position": "evaluations/position",
    "cells_per_position": "cells/position",
    "seeds_per_position": "seeds/position",
    "newton_steps_per_position": "Newton steps/position",
    "two_contacts": "two contacts",
    "failures": "failures",
    "worst_gouge_mm": "worst gouge, mm",
    "deep_gouge_mm": "99.9 % less deep, mm",
    "gouging": "gouging",
}
# Of the usable positions this percentage is less deep than deep_gouge_mm.
DEEP_PERCENT = 99.9
MICROSECONDS = 1e6  # in a second

Row = dict[str, Any]
T = TypeVar("T")


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
    for method in methods or method_names():
        for surface, spec in jobs.items():
            own = replace(spec.method, name=method, options={}, contact_spacing_mm=0.0)
            with_method = replace(spec, method=own, label="--methods")
            check_method(with_method)
            result += [Run(surface, replace(with_method, label=spec.label), count) for count in counts]
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
    """Place the run's positions, without any put in between, and judge them by the certificate."""
    stages = Stages(on_progress, threads=run.threads)
    scene = prepare(run.job, None, stages)
    row, positions = timed(run, scene, stages)
    gouge_mm, proven_mm = _gouges(run.job, scene, positions, stages)
    some = len(gouge_mm) > 0
    return row | {
        "gouging": int(np.count_nonzero(gouge_mm > run.job.tolerance.gouge_mm)),
        "worst_gouge_mm": float(gouge_mm.max()) if some else None,
        "deep_gouge_mm": float(np.percentile(gouge_mm, DEEP_PERCENT)) if some else None,
        "proven_gouge_mm": float(proven_mm.max()) if some and np.isfinite(proven_mm).all() else None,
        "guarantee": guarantee_of(run.job),
    }


def _least_time(place: Callable[[], T]) -> tuple[T, float, float]:
    """The result, and the least seconds by the clock and of the processor; a short run is repeated."""
    clock_s: list[float] = []
    cpu_s: list[float] = []
    while True:
        start_s, start_cpu_s = time.perf_counter(), time.process_time()
        placed = place()
        clock_s.append(time.perf_counter() - start_s)
        cpu_s.append(time.process_time() - start_cpu_s)
        if len(clock_s) == MOST_REPEATS or sum(clock_s) >= REPEATED_S:
            return placed, min(clock_s), min(cpu_s)


def timed(run: Run, scene: Scene, stages: Stages) -> tuple[Row, Positions]:
    """Place the run's positions: what they took, and how they ended. Neither index nor judging is counted."""
    footprint = lay_out(run.job, scene, stages)
    positioner = make_positioner(run.job, scene, stages)
    placed, wall_s, cpu_s = _least_time(
        lambda: stages.run_native("positions", positioner.place, footprint.points)
    )
    positions = as_positions(footprint, placed)
    count = len(positions)
    statuses = dict(Counter(positions.status.tolist()).most_common())
    row = {
        "method": run.job.method.name,
        "surface": run.surface,
        "threads": run.threads,
        "positions": count,
        "microseconds_per_position": MICROSECONDS * wall_s / count,
        "cpu_microseconds_per_position": MICROSECONDS * cpu_s / count,
        "positions_per_second": count / wall_s,
        "index_s": stages.seconds["index"],
        **{f"{name}_per_position": value / count for name, value in placed["counters"].items()},
        "two_contacts": statuses.get("two_contacts", 0) / count,
        "failures": count - int(np.count_nonzero(positions.usable)),
        "statuses": statuses,
    }
    return row, positions


def _gouges(job: Job, scene: Scene, positions: Positions, stages: Stages) -> tuple[Floats, Floats]:
    """(M,) mm for each usable position: how deep a point the certificate met inside the tool, and how deep it proves no
    point to lie; 0: the position does not cut in."""
    usable = positions.usable
    found = stages.run_native(
        "certificates",
        _core.certify_poses,
        scene.model,
        scene.tool,
        positions.tip[usable],
        positions.axis[usable],
        tolerance_mm=job.tolerance.gouge_mm,
    )
    return np.maximum(0.0, -found["hi"]), np.maximum(0.0, -found["lo"])


def to_json(rows: Sequence[Row], more: Mapping[str, Any] = MappingProxyType({})) -> str:
    """The text of bench.json or scaling.json, `more` beside the rows; ValueError for NaN or an infinity."""
    return json.dumps({"rows": list(rows), **more}, indent=2, allow_nan=False) + "\n"


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
    cells = [tuple(COLUMNS.values()), *map(_cells, rows)]
    widths = [max(map(len, column)) for column in zip(*cells)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in cells
    )


def _cells(row: Row) -> tuple[str, ...]:
    return tuple(_cell(row[name]) for name in COLUMNS)


def _cell(value: Any) -> str:
    """Large numbers whole, those below 100 with a decimal, small ones to the nanometre."""
    if not isinstance(value, float):
        return "none" if value is None else str(value)
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.1f}" if abs(value) >= 1 else f"{value:.6f}"
