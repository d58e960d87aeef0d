"""The proof program: what an operator runs before the first part, to see that the machine file has the right axes,
senses and order. High over the part, without spindle and coolant, the tool is held at one place and tilted to known
directions; after each the machine waits, and a comment tells what must be seen."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..base import Floats
from ..job import Job, control_deviation_deg, control_tip_deviation_mm
from ..machine import axes_of, joint_path
from ..posts import Program, ProgramTool
from .making import ProgramFile, Shop

FILE_STEM = "proof"
# Over the top of the part, in the middle of it.
HEIGHT_MM = 100.0
TILTS_DEG = (10.0, 30.0)
AZIMUTHS_DEG = (0.0, 90.0, 180.0, 270.0)


def directions() -> tuple[Floats, list[str]]:
    """Unit axes (N, 3), upright first and last, and what the operator is told of each."""
    turns = [(0.0, 0.0), *((tilt, azimuth) for tilt in TILTS_DEG for azimuth in AZIMUTHS_DEG), (0.0, 0.0)]
    tilt, azimuth = np.radians(np.array(turns)).T
    axes = np.stack((np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), np.cos(tilt)), axis=-1)
    return axes, [_words(*turn, axis) for turn, axis in zip(turns, axes)]


def _words(tilt_deg: float, azimuth_deg: float, axis: Floats) -> str:
    x, y, z = np.round(axis, 4) + 0.0  # no minus zero
    return f"TILT {tilt_deg:g} TOWARDS AZIMUTH {azimuth_deg:g} - TOOL POINTS TO {x:.4f} {y:.4f} {z:.4f}"


def proof_program(job: Job, shop: Shop, box: tuple[Floats, Floats]) -> Program:
    """The program as its post writes it; `box`: low and high corner of the part in the set-up frame."""
    axes, told = directions()
    low, high = box
    place = np.append(0.5 * (low[:2] + high[:2]), high[2] + HEIGHT_MM)
    count = len(axes)
    moves = joint_path(
        shop.machine,
        np.full(count, "rapid"),
        np.tile(place, (count, 1)),
        axes,
        np.zeros(count),
        axis_tolerance_deg=control_deviation_deg(job),
        tip_tolerance_mm=None if job.post.tcp else control_tip_deviation_mm(job),
    )
    last = np.append(np.flatnonzero(np.diff(moves.move)), len(moves) - 1)
    return Program(
        name=job.post.program_name,
        machine=shop.machine,
        tool=ProgramTool(job.post.tool_number, job.tool.radius_mm, job.tool.minor_radius_mm),
        spindle_rpm=job.post.spindle_rpm,
        moves=moves,
        axes_mm=None if job.post.tcp else axes_of(shop.machine, moves),
        options=replace(shop.options, coolant="off"),
        stops={int(row): told[moves.move[row]] for row in last},
        spindle_on=False,
    )


def proof_file(job: Job, shop: Shop, box: tuple[Floats, Floats]) -> ProgramFile:
    """Its text. Raises InputError for a post that cannot write it."""
    with job.blamed(job.post.table):
        text = shop.post.write(proof_program(job, shop, box))
    return ProgramFile(FILE_STEM + shop.post.file_ending, text)
