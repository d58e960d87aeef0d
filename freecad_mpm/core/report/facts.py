"""The report: what was done and how good it is, as facts (report.json) and as text (report.txt)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

import numpy as np

from ...version import __version__
from ..job import Job, Tolerance, cut_depth_mm
from ..machine import Machine
from ..path import ToolPath
from ..positioning import Positions
from ..program import Made
from ..removal import Cut, report
from .statement import statement
from .verdict import Verdict, digging, gaps, gouging, undecided, unproven_links
from .warnings import slowed, unproven, warnings

Facts = dict[str, Any]


def facts(
    job: Job,
    machine: Machine,
    positions: Positions,
    path: ToolPath,
    made: Made,
    counters: Mapping[str, int],
    seconds: Mapping[str, float],
    verdict: Verdict,
) -> Facts:
    """All figures of a plan as plain values, ready for JSON; positions and path in the part's frame."""
    return {
        "version": __version__,
        "verdict": verdict.facts,
        "warnings": warnings(job, machine, positions, path, verdict.guarantee)
        + unproven(path)
        + slowed(machine, path, made),
        "job": _job_facts(job),
        "positions": _position_facts(job, positions, verdict.guarantee),
        "worst_position": _worst_position(positions),
        "path": _path_facts(job, positions, path, verdict.guarantee),
        "program": _program_facts(made),
        "work": _work_facts(counters, len(positions)),
        "time": _time_facts(seconds, int(np.count_nonzero(~positions.inserted))),
        "statement": statement(positions, path, job.tolerance, verdict.guarantee),
    }


def _job_facts(job: Job) -> Facts:
    """Every key of every table, and where the job came from."""
    return asdict(job)


def _position_facts(job: Job, positions: Positions, guarantee: str) -> Facts:
    with_contact = np.isfinite(positions.contacts).all(axis=2)
    return {
        "count": len(positions),
        "passes": len(np.unique(positions.pass_index)),
        "statuses": dict(Counter(positions.status.tolist()).most_common()),
        "with_first_contact": int(np.count_nonzero(with_contact[:, 0])),
        "with_second_contact": int(np.count_nonzero(with_contact[:, 1])),
        "gouging": int(np.count_nonzero(gouging(positions, job.tolerance))),
        "undecided": int(np.count_nonzero(undecided(positions, job.tolerance, guarantee))),
        "left_out": int(np.count_nonzero(~positions.usable)),
        "inserted": int(np.count_nonzero(positions.inserted)),
        "guarantee": guarantee,
    }


def _worst_position(positions: Positions) -> Facts | None:
    """The usable position with the least upper bound of its clearance; None when there is none."""
    if not positions.usable.any():
        return None
    worst = int(np.argmin(np.where(positions.usable, positions.clearance[:, 1], np.inf)))
    return {
        "position": worst,
        "pass": int(positions.pass_index[worst]),
        "tip_mm": positions.tip[worst].tolist(),
        "axis": positions.axis[worst].tolist(),
        "clearance_mm": float(positions.clearance[worst, 1]),
    }


def _path_facts(job: Job, positions: Positions, path: ToolPath, guarantee: str) -> Facts:
    cuts = path.kind == "cut"
    lengths = np.linalg.norm(np.diff(path.tip, axis=0, prepend=path.tip[:1]), axis=1)
    return {
        "moves": len(path),
        "kinds": dict(Counter(path.kind.tolist()).most_common()),
        "cut_length_mm": float(lengths[cuts].sum()),
        "worst_cut_clearance_mm": float(path.clearance[cuts].min()) if cuts.any() else None,
        "cuts_too_deep": int(np.count_nonzero(digging(path, job.tolerance, guarantee))),
        "cuts_guarantee": guarantee,
        "moves_not_cut": len(gaps(positions, path)),
        "blocked_moves": int(np.count_nonzero(path.blocked)),
        "links_not_proven": np.flatnonzero(unproven_links(path)).tolist(),
    }


def _program_facts(made: Made) -> Facts:
    return {
        "file": made.program.file_name,
        "lines": made.report.lines(),
        **made.report.to_dict(),
        "moves": len(made.joints),
        "moves_beyond_machine": int(np.count_nonzero(made.joints.status != "ok")),
    }


def _work_facts(counters: Mapping[str, int], count: int) -> Facts:
    return {**counters, **{f"{name}_per_position": value / count for name, value in counters.items()}}


def _time_facts(seconds: Mapping[str, float], count: int) -> Facts:
    return {
        "stages_s": dict(seconds),
        "total_s": sum(seconds.values()),
        "positions_per_second": count / seconds["positions"],
    }


def with_cut(plain: Facts, tolerance: Tolerance, cut: Cut) -> Facts:
    """A plan's facts and what the removal, which knows nothing of the method, found of its path; a face that it finds
    cut deeper than the tolerances allow makes the plan bad."""
    told = plain["verdict"]
    verdict = Verdict(plain["positions"]["guarantee"], tuple(told["troubles"]))
    depth = cut_depth_mm(tolerance, verdict.guarantee)
    if not cut.good(depth):
        verdict = verdict.with_trouble(f"the removal finds a face cut deeper than {depth:g} mm")
    return {**plain, "verdict": verdict.facts, "cut": report.facts(cut, {})}
