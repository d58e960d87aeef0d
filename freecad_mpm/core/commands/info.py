"""`info`: list the faces of a part."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ..part import info_lines
from .common import GOOD
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    parser.add_argument("file", metavar="FILE", help="STEP, IGES, BREP or Bézier text")


def run(given: Namespace, progress: ProgressLine) -> int:
    print(*info_lines(given.file), sep="\n")
    return GOOD
