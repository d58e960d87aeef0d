"""`picture`: draw tool and machine at chosen positions of a job's path."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from .. import job, planning
from ..base import Stages, output
from ..pictures import playback
from .common import GOOD, add_threads, whole, write
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """The job and its positions, counted from 1 as people do."""
    parser.add_argument("job", metavar="JOB.toml")
    parser.add_argument(
        "--position", metavar="N", nargs="+", type=_position, required=True, help="in machining order, from 1"
    )
    parser.add_argument("--out", metavar="DIR", default="out", help="folder for the pictures; default: out")
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Plan the job anew and write one PNG a position; status 0 whatever the verdict is."""
    output.check_folder(given.out)
    computed = planning.plan(job.load(given.job), on_progress=progress, threads=given.threads)
    stages = Stages(progress, threads=given.threads)
    files = stages.run("pictures", playback.of_plan, computed, given.position)
    progress.clear()
    write(given.out, files)
    return GOOD


def _position(text: str) -> int:
    return whole(text, 1)
