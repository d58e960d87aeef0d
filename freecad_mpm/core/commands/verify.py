"""`verify`: judge the poses of a CL file against a job's part and tool."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from .. import job, path
from ..base import Stages
from .common import GOOD, NOT_GOOD, add_threads
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """The job, whose part and tool judge, and the CL file."""
    parser.add_argument("job", metavar="JOB.toml")
    parser.add_argument("cl_file", metavar="cl.csv")
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Status 1 when a pose cuts too deep or a move is not proven free; nothing is written."""
    spec = job.load(given.job)
    found = path.verify(spec, path.read_csv(given.cl_file), Stages(progress, threads=given.threads))
    progress.clear()
    print(*found.lines, sep="\n")
    return GOOD if found.good else NOT_GOOD
