"""The report as JSON and as text."""

from __future__ import annotations

import json
from dataclasses import asdict

from ..job import PROVEN, words
from .figures import PathFigures
from .report import Facts, Report


def to_json(report: Report) -> str:
    """report.json; infinities, which JSON has not, would be our bug."""
    return json.dumps(to_dict(report), indent=2, allow_nan=False) + "\n"


def to_dict(report: Report) -> Facts:
    """Plain values, as JSON holds them; what there is not is left out, but for the worst position."""
    worst, program = report.worst_position and asdict(report.worst_position), report.program
    if worst:
        worst["pass"] = worst.pop("pass_index")
    facts = {
        "version": report.version,
        "verdict": report.verdict.facts,
        "warnings": list(report.warnings),
        "job": report.job,
        "positions": asdict(report.positions),
        "worst_position": worst,
        "path": asdict(report.path),
        "program": {
            "file": program.file,
            "lines": program.report.lines(),
            **program.report.to_dict(),
            "moves": program.moves,
            "moves_beyond_machine": program.moves_beyond_machine,
        },
        "work": dict(report.work),
        "time": asdict(report.time),
        "statement": report.statement,
    }
    if report.contact_spacing:
        facts["contact_spacing"] = asdict(report.contact_spacing)
    if report.cut:
        facts["cut"] = report.cut.to_dict()
    return facts


def text(report: Report) -> str:
    """report.txt: the same for people, the verdict first."""
    blocks = [
        [f"Verdict: {report.verdict.line}"],
        [f"Warning: {warning}" for warning in report.warnings],
        _job_lines(report.job),
        _position_lines(report),
        _path_lines(report.path),
        report.cut.worst_lines() if report.cut else [],
        report.program.report.lines(),
        _time_lines(report),
        [report.statement[0].upper() + report.statement[1:] + "."],
    ]
    return "\n\n".join("\n".join(block) for block in blocks if block) + "\n"


def _job_lines(job: Facts) -> list[str]:
    return [f"Job:       {job['label']}", *words.job_lines(job)]


def _position_lines(report: Report) -> list[str]:
    positions, worst = report.positions, report.worst_position
    inserted = f", {positions.inserted} of them put in between for the cuts" if positions.inserted else ""
    lines = [f"{positions.count} positions in {positions.passes} passes{inserted}:"]
    lines += [f"  {count:8d}  {status}" for status, count in positions.statuses.items()]
    lines.append(
        f"Contacts: {positions.with_first_contact} first, {positions.with_second_contact} second; "
        f"{positions.gouging} gouging, {positions.undecided} undecided"
    )
    if report.contact_spacing:
        lines.append(report.contact_spacing.sentence)
    if worst:
        x, y, z = worst.tip_mm
        lines.append(
            f"Worst clearance: {worst.clearance_mm:.6f} mm ({positions.guarantee}) at position "
            f"{worst.position}, pass {worst.pass_index}, tip {x:.3f} {y:.3f} {z:.3f}"
        )
    return lines


def _path_lines(path: PathFigures) -> list[str]:
    kinds = ", ".join(f"{count} {kind}" for kind, count in path.kinds.items())
    lines = [f"{path.moves} moves ({kinds}), {path.cut_length_mm:.1f} mm of cuts"]
    if path.worst_cut_clearance_mm is not None:
        what = "at least" if path.cuts_guarantee == PROVEN else "sampled, no proof:"
        lines.append(
            f"Clearance of the cuts between their positions: {what} {path.worst_cut_clearance_mm:.6f} mm; "
            f"{path.cuts_too_deep} cuts too deep, {path.blocked_moves} moves blocked, "
            f"{len(path.links_not_proven)} links not proven"
        )
    return lines


def _time_lines(report: Report) -> list[str]:
    time, work = report.time, report.work
    stages = ", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in time.stages_s.items())
    return [
        f"Time: {time.total_s:.2f} s ({stages})",
        f"{time.positions_per_second:.0f} positions per second, "
        f"{work['evaluations_per_position']:.0f} surface evaluations and {work['cells_per_position']:.0f} bounded cells "
        "per position",
    ]
