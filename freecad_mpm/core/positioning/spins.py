"""All spins of the tool over a few footprint points: where the second contacts lie, how far apart the contacts are, and
how wide a strip each spin machines (docs/strip.md)."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ... import _core
from ..base import Floats, InputError, Names, Stages
from ..job import ACROSS, DIRECT, Job
from ..part import FaceArrays, Scene
from . import spacing, strip
from .footprint import lay_out
from .placing import make_positioner

DEFAULT_PLACES = ((0.25, 0.25), (0.75, 0.25), (0.5, 0.55), (0.25, 0.75), (0.75, 0.75))
HEADER = "x,y,spin_deg,status,q_x,q_y,q_z,tilt_deg,axis_x,axis_y,axis_z,clearance_lo_mm,across_mm,direct_mm,strip_mm"


@dataclass(frozen=True)
class Spread:
    """K spins at each of N points, set-up frame, mm; NaN: none."""

    points: Floats  # (N, 2)
    spin_deg: Floats  # (K,)
    status: Names  # (N, K)
    contacts: Floats  # (N, K, 2, 3)
    tilt_deg: Floats  # (N, K)
    axis: Floats  # (N, K, 3)
    clearance: Floats  # (N, K, 2)
    across: Floats  # (N, K): spacing of the contacts seen along the feed
    direct: Floats  # (N, K): from one to the other
    strip: Floats  # (N, K): width of the strip within scallop_mm
    scallop_mm: float


def spread(
    job: Job, scene: Scene, points: Floats, spin_deg: Floats, scallop_mm: float, stages: Stages
) -> Spread:
    """Place the job's method over `points` (N, 2) with every spin (K,).

    Raises InputError when the method cannot spin, and for a point that lies beside the part for all spins."""
    if not _core.METHODS[job.method.name]["spins"]:
        raise job.error(job.method.table, "name", f"{job.method.name} cannot spin")
    positioner = make_positioner(job, scene, stages)
    placed = stages.run_native("positions", positioner.place_spins, points, spin_deg)
    shape = (len(points), len(spin_deg))
    contacts = placed["contacts"].reshape(*shape, 2, 3)
    status = np.array(_core.POSITION_STATUS)[placed["status"]].reshape(shape)
    for x, y in points[(status == "off_part").all(axis=1)][:1]:
        raise InputError(f"({x:g}, {y:g}): lies beside the part: no spin of the tool touches it there")
    tip, axis = placed["tip"].reshape(*shape, 3), placed["axis"].reshape(*shape, 3)
    along = spacing.feed(job.footprint.direction_deg)
    widths = stages.run("strips", _widths, scene, points, tip, axis, contacts, along, scallop_mm)
    across, direct = (
        spacing.contact_spacing(contacts, status, measure, along) for measure in (ACROSS, DIRECT)
    )
    return Spread(
        points,
        spin_deg,
        status,
        contacts,
        placed["tilt_deg"].reshape(shape),
        axis,
        placed["clearance"].reshape(*shape, 2),
        across,
        direct,
        widths,
        scallop_mm,
    )


def _widths(
    scene: Scene,
    points: Floats,
    tip: Floats,
    axis: Floats,
    contacts: Floats,
    along: Floats,
    scallop_mm: float,
) -> Floats:
    faces: list[FaceArrays] = [face.transformed(scene.frame) for face in scene.machined]
    widths = np.full(tip.shape[:2], np.nan)
    for i, at in enumerate(points):
        ground = strip.ground_under(faces, at, scene.tool.radius)
        for k in range(tip.shape[1]):
            widths[i, k] = strip.width_mm(
                scene.tool, tip[i, k], axis[i, k], contacts[i, k, 0], ground, along, scallop_mm
            )
    return widths


def chosen_points(job: Job, scene: Scene, wanted: Sequence[tuple[float, float]], stages: Stages) -> Floats:
    """The wanted points (N, 2), or those of the job's footprint nearest to DEFAULT_PLACES of its box."""
    if wanted:
        return np.array(wanted, dtype=float)
    points = lay_out(job, scene, stages).points
    low, high = points.min(axis=0), points.max(axis=0)
    places = low + np.array(DEFAULT_PLACES) * (high - low)
    return points[[int(np.argmin(np.linalg.norm(points - at, axis=1))) for at in places]]


def summary(found: Spread) -> list[str]:
    """One line a point for people: ranges over all spins with two contacts."""
    lines = []
    for i, (x, y) in enumerate(found.points):
        two = found.status[i] == "two_contacts"
        if not two.any():
            lines.append(f"({x:g}, {y:g}): no spin has two contacts")
            continue
        ranges = (
            f"{name} {np.nanmin(values[i, two]):.2f} to {np.nanmax(values[i, two]):.2f} mm"
            for name, values in (("PQ", found.direct), ("across", found.across), ("strip", found.strip))
        )
        lines.append(
            f"({x:g}, {y:g}): {np.count_nonzero(two)} of {len(two)} spins have two contacts, {', '.join(ranges)}"
        )
    return lines


def circle(step_deg: float) -> Floats:
    """Spins all round, from -180 on, about step_deg apart."""
    count = max(1, round(360.0 / step_deg))
    return -180.0 + 360.0 * np.arange(count) / count


def to_csv(found: Spread) -> str:
    """One line a point and spin, set-up frame."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(HEADER.split(","))
    for i, k in np.ndindex(found.status.shape):
        numbers: Sequence[float] = (
            *found.contacts[i, k, 1],
            found.tilt_deg[i, k],
            *found.axis[i, k],
            found.clearance[i, k, 0],
            found.across[i, k],
            found.direct[i, k],
            found.strip[i, k],
        )
        place = [f"{value:.6f}" for value in (*found.points[i], found.spin_deg[k])]
        writer.writerow([*place, found.status[i, k], *(_text(value) for value in numbers)])
    return text.getvalue()


def _text(value: float) -> str:
    return "" if np.isnan(value) else f"{value:.6f}"
