"""What the commands share: the exit status, kinds of arguments, and handing over files."""

from __future__ import annotations

import math
from argparse import ArgumentParser, ArgumentTypeError

from ..base import output

GOOD, NOT_GOOD = 0, 1

Files = dict[str, bytes | str]


def add_threads(parser: ArgumentParser) -> None:
    """The argument --threads."""
    parser.add_argument("--threads", metavar="N", type=_threads, default=0, help="0, the default: all cores")


def positive(text: str) -> float:
    """An argument that is a number greater than 0."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise ArgumentTypeError(f"must be a positive number, got '{text}'")
    return value


def whole(text: str, least: int) -> int:
    """An argument that is a whole number from `least`."""
    if not text.isdecimal() or int(text) < least:
        raise ArgumentTypeError(f"must be a whole number from {least}, got '{text}'")
    return int(text)


def write(folder: str, files: Files) -> None:
    """Write the files together and list them."""
    print("\nWritten:")
    for path in output.write_together(folder, files):
        print(f"  {path}")


def _threads(text: str) -> int:
    return whole(text, 0)
