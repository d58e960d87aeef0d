"""What of a plan is kept in the operation beside its Path: figures for people, and what the 3D view draws."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np
from FreeCAD import Vector

from ..core.base import Floats

NO_STATUS = -1
# Of the worst clearance in mm; documents keep no rounding errors.
CLEARANCE_DECIMALS = 9


def store(obj: Any, plan: Any, report: str) -> None:
    """Fill the result properties from a core `Plan` and its report text."""
    counts = Counter(map(str, plan.status))
    obj.Positions = len(plan.status)
    obj.WorstClearance = worst_clearance(plan.clearance)
    obj.Statuses = [f"{name}: {count}" for name, count in counts.most_common()]
    obj.Report = report
    obj.Verdict, obj.Good = plan.report.verdict.line, plan.report.verdict.good
    obj.StatusNames = list(counts)
    obj.MoveStatus = _move_status(plan, list(counts))
    visited = plan.path.position[plan.path.position >= 0]
    obj.PositionClearance = plan.clearance[visited, 1].round(CLEARANCE_DECIMALS).tolist()
    obj.FirstContacts, obj.SecondContacts = (_vectors(plan.contacts[:, which]) for which in (0, 1))


def clear(obj: Any) -> None:
    """Take back everything `store` gave."""
    obj.Positions, obj.WorstClearance, obj.Report, obj.Verdict, obj.Good = 0, 0.0, "", "", False
    for name in (
        "Statuses",
        "StatusNames",
        "MoveStatus",
        "PositionClearance",
        "FirstContacts",
        "SecondContacts",
    ):
        setattr(obj, name, [])


def worst_clearance(clearance: Floats) -> float:
    """The smallest upper bound of the positions' clearances, mm; 0 when no position has one."""
    known = clearance[:, 1][np.isfinite(clearance[:, 1])]
    return round(float(known.min()), CLEARANCE_DECIMALS) if len(known) else 0.0


def _move_status(plan: Any, names: list[str]) -> list[int]:
    code = np.array([names.index(status) for status in map(str, plan.status)], dtype=int)
    position = np.asarray(plan.path.position)
    return np.where(position < 0, NO_STATUS, code[np.maximum(position, 0)]).tolist()


def _vectors(points: Floats) -> list[Vector]:
    return [Vector(*point) for point in points[np.isfinite(points).all(axis=1)].tolist()]
