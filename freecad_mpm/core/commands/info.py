"""`info`: list the faces of a part."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ..part import info_lines
from .common import GOOD
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """Only the file: its ending tells its format."""
    parser.add_argument("file", metavar="FILE", help="STEP, IGES, BREP or Bézier text")


def run(given: Namespace, progress: ProgressLine) -> int:
    """Print one line a face; nothing is written. Raises InputError for a file that cannot be read."""
    print(*info_lines(given.file), sep="\n")
    return GOOD
