"""`plan`: compute a job: positions, path, program, report."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace
from dataclasses import replace

from .. import job, planning, removal
from ..base import Stages, output
from ..report import text, with_cut
from . import plan_files
from .common import GOOD, NOT_GOOD, add_threads, write
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """The job and the folder; --proof asks for one program more."""
    parser.add_argument("job", metavar="JOB.toml")
    parser.add_argument(
        "--out", metavar="DIR", required=True, help="folder for the results, made when missing"
    )
    parser.add_argument(
        "--proof",
        action="store_true",
        help="also write a program that shows whether the machine file is right",
    )
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Print the report and write all files, also when the verdict, and so the status, is not good."""
    output.check_folder(given.out)
    computed = planning.plan(job.load(given.job), on_progress=progress, threads=given.threads)
    resolution = removal.default_resolution_mm(computed.scene)
    cut = removal.cut(computed.scene, computed.path, resolution, on_progress=progress, threads=given.threads)
    computed = replace(computed, report=with_cut(computed.report, computed.job.tolerance, cut))
    files = plan_files.files(computed, cut, Stages(progress, threads=given.threads))
    if given.proof:
        files |= plan_files.proof(computed)
    progress.clear()
    print(text(computed.report), end="")
    write(given.out, files)
    return GOOD if computed.report.verdict.good else NOT_GOOD
