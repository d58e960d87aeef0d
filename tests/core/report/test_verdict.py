"""When a plan is good."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from freecad_mpm.core.job import Tolerance
from freecad_mpm.core.path import ToolPath
from freecad_mpm.core.positioning import Positions
from freecad_mpm.core.report import judge
from freecad_mpm.core.report.verdict import gaps

TOLERANCE = Tolerance(gouge_mm=0.01, chord_mm=0.1)


def positions(status: str = "two_contacts", low: float = -np.inf, high: float = 0.0) -> Positions:
    """One position."""
    numbers = np.zeros(1)
    return Positions(
        tip=np.zeros((1, 3)),
        axis=np.array([[0.0, 0.0, 1.0]]),
        contacts=np.zeros((1, 2, 3)),
        normals=np.zeros((1, 2, 3)),
        status=np.array([status]),
        clearance=np.array([[low, high]]),
        tilt_deg=numbers,
        spin_deg=numbers,
        pass_index=np.zeros(1, dtype=int),
        inserted=np.zeros(1, dtype=bool),
    )


def path(kind: str = "cut", clearance: float = 0.0, blocked: bool = False, proven: bool = True) -> ToolPath:
    """One move."""
    zero = np.zeros(1, dtype=int)
    up = np.array([[0.0, 0.0, 1.0]])
    flags = np.array([blocked]), np.array([proven])
    return ToolPath(np.array([kind]), 0 * up, up, zero, zero, np.array([clearance]), *flags)


CASES = [
    ("good", positions(), path(), [], "sampled", None),
    ("just within", positions(high=-0.01), path(), [], "sampled", None),
    ("a gouge", positions(high=-0.011), path(), [], "sampled", "1 positions cut in deeper than 0.01 mm"),
    ("gave up", positions("undecided"), path(), [], "sampled", "1 positions are undecided"),
    ("proven", positions(low=-0.005), path(), [], "proven", None),
    ("not proven", positions(low=-0.02), path(), [], "proven", "1 positions are undecided"),
    ("a chord", positions(), path(clearance=-0.1), [], "sampled", None),
    (
        "deep chord",
        positions(),
        path(clearance=-0.12),
        [],
        "sampled",
        "1 cuts go deeper than 0.11 mm between",
    ),
    ("deep plunge", positions(), path("plunge", -0.12), [], "sampled", None),
    ("blocked", positions(), path(blocked=True), [], "sampled", "1 moves run into the part"),
    ("open link", positions(), path("rapid", proven=False), [], "proven", "1 links are not proven free"),
    ("open cut", positions(), path(proven=False), [], "sampled", None),
    ("limits", positions(), path(), ["an axis leaves its limits"], "sampled", "an axis leaves its limits"),
]


@pytest.mark.parametrize(("case", "where", "moves", "machine", "guarantee", "trouble"), CASES)
def test_verdict(
    case: str, where: Positions, moves: ToolPath, machine: list[str], guarantee: str, trouble: str | None
) -> None:
    verdict = judge(where, moves, machine, TOLERANCE, guarantee, False)
    assert verdict.good is (trouble is None)
    if trouble:
        assert trouble in verdict.line
    assert ("no proof" in verdict.line) is (guarantee == "sampled")


def test_a_cut_that_is_left_out_is_trouble_unless_it_is_allowed() -> None:
    """Two positions of one pass, each plunged to."""
    one, plunges = positions(low=0.0), path("plunge")
    two = Positions(**{name: np.concatenate((value, value)) for name, value in vars(one).items()})
    moves = ToolPath(**{name: np.concatenate((value, value)) for name, value in vars(plunges).items()})
    moves.position[:] = (0, 1)
    assert gaps(two, moves).tolist() == [1]
    strict, lenient = (judge(two, moves, [], TOLERANCE, "proven", allowed) for allowed in (False, True))
    assert strict.troubles == ("1 moves between neighbours of a pass are not cut",) and lenient.good
    cut = replace(moves, kind=np.array(["plunge", "cut"]))
    assert judge(two, cut, [], TOLERANCE, "proven", False).good
