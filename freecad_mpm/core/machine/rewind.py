"""Fitting a path to the machine: where a rotary axis must rewind in a cut, the tool retracts, turns clear of the
part, and goes on from the place where it left."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import numpy as np

from ... import _core
from ..base import Floats, Integers, Stages
from ..job import Job
from ..part import Scene
from ..path import ToolPath, from_core, link_options
from .joints import JointPath, move_machine
from .machine import Machine

FORCED = "forced_turn"
TURN_DEG = 360.0
# Halvings until the place where an axis reaches its limit is known to the last digit.
BISECTIONS = 60
# The joints are chosen anew over the whole path after each round; more than one is only needed when that moves a rewind.
ROUNDS = 4
NO_POSITION = -1


def fit_to_machine(
    job: Job, machine: Machine, scene: Scene, path: ToolPath, guarantee: str, stages: Stages
) -> tuple[ToolPath, JointPath]:
    """The machine's joints along the path, all in the set-up frame, and the path with the retracts that they need.
    guarantee: of the positions. What the machine cannot do all the same is a status of its moves."""
    joints = stages.run("machine", move_machine, job, machine, path)
    for _ in range(ROUNDS):
        forced = forced_cuts(path, joints)
        if not len(forced):
            break
        seams = [seam(machine, path, joints, int(move)) for move in forced]
        path = interrupted(job, scene, path, forced, seams, link_options(job, guarantee), stages)
        joints = stages.run("machine", move_machine, job, machine, path)
    return path, joints


def forced_cuts(path: ToolPath, joints: JointPath) -> Integers:
    """Cuts of the path, rising, in which a rotary axis has to rewind or take its other solution."""
    moves = np.unique(joints.move[joints.status == FORCED])
    return np.asarray(moves[path.kind[moves] == "cut"])


def seam(machine: Machine, path: ToolPath, joints: JointPath, move: int) -> float:
    """The fraction of a cut at which the rotary axis that has to rewind reaches its limit; 0 where it can as well rewind
    before the cut begins."""
    rows = np.flatnonzero(joints.move == move)
    start, end = joints.rotary_deg[rows[0] - 1], joints.rotary_deg[rows[-1]]
    axis = int(np.argmax(np.abs(end - start)))
    rotary, up = machine.rotary_axes[axis], end[axis] < start[axis]
    rewound = start[axis] - math.copysign(TURN_DEG, start[axis] - end[axis])
    if rotary.min_limit_deg <= rewound <= rotary.max_limit_deg:
        return 0.0
    limit = rotary.max_limit_deg if up else rotary.min_limit_deg
    chain, low, high = machine.chain(), 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        tip, direction = _pose(path, move, middle)
        both = chain.inverse(tip[None], direction[None])["rotary_deg"][0]
        away = (both[:, axis] - start[axis] + 0.5 * TURN_DEG) % TURN_DEG - 0.5 * TURN_DEG
        reading = start[axis] + away[np.argmin(np.abs(both[:, 1] - start[1]))]
        low, high = (low, middle) if (reading > limit) == up and reading != limit else (middle, high)
    return low


def interrupted(
    job: Job,
    scene: Scene,
    path: ToolPath,
    cuts: Integers,
    seams: list[float],
    options: _core.LinkOptions,
    stages: Stages,
) -> ToolPath:
    """The path with each of these cuts interrupted a fraction of it from its start, there a way up to the safe plane
    and down again. The rapid down is where the axes turn: at its upper end, with the tip held."""
    with job.blamed(job.link.table):
        ways = [
            stages.run_native("path", _interruption, scene, path, int(move), where, options)
            for move, where in zip(cuts, seams)
        ]
    at = np.repeat(cuts, [len(way) for way in ways])
    return ToolPath(
        **{
            one.name: np.insert(
                getattr(path, one.name), at, np.concatenate([getattr(way, one.name) for way in ways]), axis=0
            )
            for one in fields(ToolPath)
        }
    )


def _pose(path: ToolPath, move: int, fraction: float) -> tuple[Floats, Floats]:
    """Tip and axis that far along a cut."""
    before = move - 1
    return _core.pose_between(path.tip[before], path.axis[before], path.tip[move], path.axis[move], fraction)


def _interruption(
    scene: Scene,
    path: ToolPath,
    move: int,
    fraction: float,
    options: _core.LinkOptions,
    *,
    context: _core.Context,
) -> ToolPath:
    """The first piece of a cut, when there is one, and the way up and down from its end."""
    tip, axis = _pose(path, move, fraction)
    way = _up_and_down(scene, tip, axis, int(path.pass_index[move]), options, context=context)
    if fraction == 0.0:
        return way
    piece = {"kind": "cut", "tip": tip, "axis": axis, "position": NO_POSITION}
    kept = {name: getattr(path, name)[move] for name in ("pass_index", "clearance", "blocked", "proven")}
    first = {name: np.array([value]) for name, value in {**piece, **kept}.items()}
    return ToolPath(**{name: np.concatenate((column, getattr(way, name))) for name, column in first.items()})


def _up_and_down(
    scene: Scene,
    tip: Floats,
    axis: Floats,
    pass_index: int,
    options: _core.LinkOptions,
    *,
    context: _core.Context,
) -> ToolPath:
    """From a pose to the safe plane and back to it: the link between two positions that are one and the same."""
    found = _core.link_passes(
        scene.cells,
        scene.tool,
        np.array([tip, tip]),
        np.array([axis, axis]),
        np.array([0, 1]),
        np.ones(2, dtype=bool),
        options=options,
        context=context,
    )
    linked = from_core(found)
    first, last = np.flatnonzero(linked.position >= 0)
    way = ToolPath(**{one.name: getattr(linked, one.name)[first + 1 : last + 1] for one in fields(ToolPath)})
    count = len(way)
    return replace(
        way, position=np.full(count, NO_POSITION), pass_index=np.full(count, pass_index, way.pass_index.dtype)
    )


def rewinds(path: ToolPath) -> Integers:
    """Positions before which a cut is interrupted."""
    again = np.flatnonzero((path.kind == "plunge") & (path.position == NO_POSITION))
    return np.asarray(path.position[again + 1])
