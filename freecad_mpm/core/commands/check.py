"""`check`: read a program's text as its control would and check it."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ..job import KEYS
from ..program import check_file
from .common import GOOD, NOT_GOOD
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """The program and the machine; post and CL file where they are known."""
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("--machine", metavar="NAME", required=True, help=KEYS["machine.name"].check.what)
    parser.add_argument("--post", metavar="NAME", help="whose dialect it is; default: the one it looks like")
    parser.add_argument(
        "--joints", action="store_true", help="it moves the joints: no tool-centre-point control"
    )
    parser.add_argument("--against", metavar="cl.csv", help="poses that the program must meet in their order")


def run(given: Namespace, progress: ProgressLine) -> int:
    """Status 1 when there is any finding; nothing is written."""
    found = check_file(given.program, given.machine, given.post, given.against, not given.joints)
    print(*found.lines, sep="\n")
    return GOOD if found.good else NOT_GOOD
