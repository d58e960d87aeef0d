"""The report as JSON and as text."""

from __future__ import annotations

import json

from ..job import PROVEN, words
from ..positioning import spacing
from ..removal import report
from .facts import Facts


def to_json(facts: Facts) -> str:
    """report.json; infinities, which JSON has not, would be our bug."""
    return json.dumps(facts, indent=2, allow_nan=False) + "\n"


def text(facts: Facts) -> str:
    """report.txt: the same for people, the verdict first."""
    blocks = [
        [f"Verdict: {facts['verdict']['line']}"],
        [f"Warning: {warning}" for warning in facts["warnings"]],
        _job_lines(facts["job"]),
        _position_lines(facts),
        _path_lines(facts["path"]),
        report.worst_lines(facts["cut"]) if "cut" in facts else [],
        facts["program"]["lines"],
        _time_lines(facts),
        [facts["statement"][0].upper() + facts["statement"][1:] + "."],
    ]
    return "\n\n".join("\n".join(block) for block in blocks if block) + "\n"


def _job_lines(job: Facts) -> list[str]:
    return [f"Job:       {job['source']}", *words.job_lines(job)]


def _position_lines(facts: Facts) -> list[str]:
    positions, worst = facts["positions"], facts["worst_position"]
    inserted = (
        f", {positions['inserted']} of them put in between for the cuts" if positions["inserted"] else ""
    )
    lines = [f"{positions['count']} positions in {positions['passes']} passes{inserted}:"]
    lines += [f"  {count:8d}  {status}" for status, count in positions["statuses"].items()]
    lines.append(
        f"Contacts: {positions['with_first_contact']} first, {positions['with_second_contact']} second; "
        f"{positions['gouging']} gouging, {positions['undecided']} undecided"
    )
    if "contact_spacing" in facts:
        lines.append(spacing.sentence(facts["contact_spacing"]))
    if worst:
        x, y, z = worst["tip_mm"]
        lines.append(
            f"Worst clearance: {worst['clearance_mm']:.6f} mm ({positions['guarantee']}) at position "
            f"{worst['position']}, pass {worst['pass']}, tip {x:.3f} {y:.3f} {z:.3f}"
        )
    return lines


def _path_lines(path: Facts) -> list[str]:
    kinds = ", ".join(f"{count} {kind}" for kind, count in path["kinds"].items())
    lines = [f"{path['moves']} moves ({kinds}), {path['cut_length_mm']:.1f} mm of cuts"]
    if path["worst_cut_clearance_mm"] is not None:
        what = "at least" if path["cuts_guarantee"] == PROVEN else "sampled, no proof:"
        lines.append(
            f"Clearance of the cuts between their positions: {what} {path['worst_cut_clearance_mm']:.6f} mm; "
            f"{path['cuts_too_deep']} cuts too deep, {path['blocked_moves']} moves blocked, "
            f"{len(path['links_not_proven'])} links not proven"
        )
    return lines


def _time_lines(facts: Facts) -> list[str]:
    time, work = facts["time"], facts["work"]
    stages = ", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in time["stages_s"].items())
    return [
        f"Time: {time['total_s']:.2f} s ({stages})",
        f"{time['positions_per_second']:.0f} positions per second, "
        f"{work['evaluations_per_position']:.0f} surface evaluations and {work['cells_per_position']:.0f} bounded cells "
        "per position",
    ]
