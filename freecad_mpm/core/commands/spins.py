"""`spins`: all spins over some points: contacts, spacing, strip width."""

from __future__ import annotations

import math
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from dataclasses import replace
from pathlib import Path

from .. import job, planning
from ..base import Stages, output
from ..part import prepare
from ..pictures import spins as pictures
from ..positioning import spacing, spins
from .common import GOOD, Files, add_threads, positive, write
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """The job, the footprint points (mm, set-up frame), the steps of the spin and the scallop."""
    parser.add_argument("job", metavar="JOB.toml")
    parser.add_argument("--out", metavar="DIR", required=True, help="folder for spins.csv and the pictures")
    parser.add_argument(
        "--at",
        metavar="X,Y",
        nargs="+",
        type=_point,
        default=[],
        help="footprint points in the set-up frame, mm; default: five of the job's footprint",
    )
    parser.add_argument(
        "--step-deg", metavar="A", type=positive, default=5.0, help="from spin to spin; default: 5"
    )
    parser.add_argument(
        "--scallop-mm", metavar="H", type=positive, default=0.05, help="of the strip; default: 0.05"
    )
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Write spins.csv and its pictures; no path is made, so the status is 0 when they are written."""
    output.check_folder(given.out)
    spec = job.load(given.job)
    stages = Stages(progress, threads=given.threads)
    scene = prepare(spec, None, stages)
    points = spins.chosen_points(spec, scene, given.at, stages)
    found = spins.spread(spec, scene, points, spins.circle(given.step_deg), given.scallop_mm, stages)
    name = f"{Path(spec.part.file).name}, {spec.method.name}"
    along = spacing.feed(spec.footprint.direction_deg)
    files: Files = {
        "spins.csv": spins.to_csv(found),
        "spins.png": pictures.draw_spread(found, along, f"{name}: all spins over {len(points)} points"),
    }
    if spec.method.contact_spacing_mm:
        plain = replace(spec, method=replace(spec.method, contact_spacing_mm=0.0))
        before, after = (
            planning.plan(one, on_progress=progress, threads=given.threads) for one in (plain, spec)
        )
        wanted = f"{spec.method.contact_spacing_mm:g} mm {spacing.MEASURES[spec.method.spacing_measure]}"
        files["spacing.png"] = pictures.draw_control(before, after, f"{name}: contacts {wanted}")
        progress.clear()
        if after.report.contact_spacing:
            print(after.report.contact_spacing.sentence)
    progress.clear()
    print(*spins.summary(found), sep="\n")
    write(given.out, files)
    return GOOD


def _point(text: str) -> tuple[float, float]:
    try:
        x, y = (float(one) for one in text.split(","))
    except ValueError:
        raise ArgumentTypeError(f"must be X,Y such as 75,40, got '{text}'") from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise ArgumentTypeError(f"must be two finite numbers, got '{text}'")
    return x, y
