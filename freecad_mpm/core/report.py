"""The report: what was done and how good it is, as facts (report.json) and as text (report.txt)."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import cut_report, spacing
from .cutting import Cut
from .job import Job
from .machines import Machine
from .motion_time import slowed_cuts
from .plan import Integers, Path, Plan, Positions
from .rewind import rewinds
from .shop import Made
from .statement import statement
from .verdict import PROVEN, Verdict, cut_depth_mm, digging, gaps, gouging, undecided, unproven_links
from .version import __version__

Facts = dict[str, Any]

# So many positions are named in a warning.
LISTED_POSITIONS = 10


def facts(
    job: Job,
    machine: Machine,
    positions: Positions,
    path: Path,
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
        + _slowed(machine, path, made),
        "job": _job_facts(job),
        "positions": _position_facts(job, positions, verdict.guarantee),
        "worst_position": _worst_position(positions),
        "path": _path_facts(job, positions, path, verdict.guarantee),
        "program": _program_facts(made),
        "work": _work_facts(counters, len(positions)),
        "time": _time_facts(seconds, int(np.count_nonzero(~positions.inserted))),
        "statement": statement(positions, path, job.tolerance, verdict.guarantee),
    }


def warnings(job: Job, machine: Machine, positions: Positions, path: Path, guarantee: str) -> list[str]:
    """What the reader must know although it does not make the plan bad."""
    found = []
    if guarantee != PROVEN:
        found.append("positions and cuts are sampled: no proof that nothing between the samples is cut")
    if not job.tool.shank and not job.tool.holder:
        found.append("the tool has no shank and no holder: only the flutes are kept clear of the part")
    if machine.unconfirmed:
        found.append(
            f"machine {machine.name} is unconfirmed: compare its file with the machine before cutting"
        )
    left_out = Counter(positions.status[~positions.usable].tolist())
    if left_out:
        found.append(f"{left_out.total()} positions ({', '.join(left_out)}) are left out of the path")
    turned = rewinds(path)
    if len(turned):
        places = _listed(turned)
        found.append(
            f"{len(turned)} cuts are interrupted for a rotary axis to rewind on the safe plane, "
            f"before positions {places}"
        )
    missing = gaps(positions, path)
    if len(missing):
        found.append(
            f"{len(missing)} moves between neighbours of a pass are not cut: the tool retracts before positions "
            f"{_listed(missing)}"
        )
    return found


def unproven(path: Path) -> list[str]:
    """The links that nobody could prove, with what is known of their clearance."""
    links = np.flatnonzero(unproven_links(path)).tolist()
    if not links:
        return []
    named = [
        f"{path.kind[move]} {_place(path, move)} (least clearance sampled {path.clearance[move]:.4f} mm)"
        for move in links[:LISTED_POSITIONS]
    ]
    more = ", …" if len(links) > LISTED_POSITIONS else ""
    return [f"{len(links)} links are not proven free: {', '.join(named)}{more}"]


def _place(path: Path, move: int) -> str:
    """Words for the position that a link leaves or makes for; the pass where there is none."""
    named = path.position >= 0
    if path.kind[move] == "retract":
        before = np.flatnonzero(named[:move])
        return f"from position {path.position[before[-1]]}" if len(before) else "at the start"
    after = np.flatnonzero(named[move:])
    return f"to position {path.position[move + after[0]]}" if len(after) else "at the end"


def _slowed(machine: Machine, path: Path, made: Made) -> list[str]:
    """Cuts in which the rotary axes cannot follow the feed."""
    moves = np.unique(made.joints.source[slowed_cuts(machine, made.joints)])
    places = path.position[moves][path.position[moves] >= 0]
    if not len(places):
        return []
    return [
        f"the rotary axes slow {len(places)} cuts down to less than half their feed, to positions {_listed(places)}"
    ]


def _listed(positions: Integers) -> str:
    more = ", …" if len(positions) > LISTED_POSITIONS else ""
    return ", ".join(map(str, positions[:LISTED_POSITIONS])) + more


def _job_facts(job: Job) -> Facts:
    method, footprint = job.method, job.footprint
    return {
        "source": job.source,
        "part": job.part.file,
        "faces": list(job.part.faces) or "all",
        "tool": job.tool.describe(),
        "footprint": {
            "pattern": footprint.pattern,
            "direction_deg": footprint.direction_deg,
            "side_step_mm": footprint.side_step_mm,
            "forward_step_mm": footprint.forward_step_mm,
            "zigzag": footprint.zigzag,
        },
        "method": method.name,
        "options": dict(method.options),
        "tilt_max_deg": method.tilt_max_deg,
        "spin_deg": method.spin_deg,
        "contact_spacing_mm": method.contact_spacing_mm,
        "gouge_tolerance_mm": job.tolerance.gouge_mm,
        "chord_tolerance_mm": job.tolerance.chord_mm,
        "machine": job.machine.name,
        "post": job.post.name,
    }


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


def _path_facts(job: Job, positions: Positions, path: Path, guarantee: str) -> Facts:
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


def with_cut(plan: Plan, cut: Cut) -> Facts:
    """The plan's facts and what the removal, which knows nothing of the method, found of its path; a face that it finds
    cut deeper than the tolerances allow makes the plan bad."""
    told = plan.report["verdict"]
    verdict = Verdict(plan.report["positions"]["guarantee"], tuple(told["troubles"]))
    depth = cut_depth_mm(plan.job.tolerance, verdict.guarantee)
    if not cut.good(depth):
        verdict = verdict.with_trouble(f"the removal finds a face cut deeper than {depth:g} mm")
    return {**plan.report, "verdict": verdict.facts, "cut": cut_report.facts(cut, {})}


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
        cut_report.worst_lines(facts["cut"]) if "cut" in facts else [],
        facts["program"]["lines"],
        _time_lines(facts),
        [facts["statement"][0].upper() + facts["statement"][1:] + "."],
    ]
    return "\n\n".join("\n".join(block) for block in blocks if block) + "\n"


def _job_lines(job: Facts) -> list[str]:
    faces = job["faces"] if isinstance(job["faces"], str) else ", ".join(job["faces"])
    footprint = job["footprint"]
    order = "zigzag" if footprint["zigzag"] else "one way"
    return [
        f"Job:       {job['source']}",
        f"Part:      {job['part']}, faces {faces}",
        f"Tool:      {job['tool']}",
        f"Footprint: {footprint['pattern']}, feed at {footprint['direction_deg']:g} deg, "
        f"steps {footprint['side_step_mm']:g} mm aside, {footprint['forward_step_mm']:g} mm forward, {order}",
        f"Method:    {job['method']}, {_spin(job)}, tilt up to {job['tilt_max_deg']:g} deg",
        f"Tolerance: gouge {job['gouge_tolerance_mm']:g} mm, chord {job['chord_tolerance_mm']:g} mm",
    ]


def _spin(job: Facts) -> str:
    wanted = job["contact_spacing_mm"]
    return f"spin for contacts {wanted:g} mm apart" if wanted else f"spin {job['spin_deg']:g} deg"


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
