"""The command line `python3 -m freecad_mpm` (docs/command-line.md)."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from types import ModuleType
from typing import NoReturn

from ..base import Cancelled, InputError, one_line
from .console import ProgressLine

BAD_INPUT = 2
INTERRUPTED, BROKEN_PIPE = 130, 141  # as shells report Ctrl-C, and a reader that has gone


class Parser(argparse.ArgumentParser):
    """Bad arguments get one line and status 2, like all bad input."""

    def error(self, message: str) -> NoReturn:
        """Called by argparse; never returns."""
        self.exit(BAD_INPUT, f"{self.prog}: {one_line(message)}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status; bad input is one line on stderr."""
    progress = ProgressLine()
    try:
        parsed = make_parser().parse_args(arguments)
        status: int = parsed.run(parsed, progress)
        sys.stdout.flush()
        return status
    except InputError as error:
        progress.clear()
        print(one_line(error), file=sys.stderr)
        return BAD_INPUT
    except (KeyboardInterrupt, Cancelled):
        progress.clear()
        print("stopped: nothing was written", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        os.dup2(
            os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno()
        )  # so that the last flush does not fail too
        return BROKEN_PIPE


def make_parser() -> Parser:
    """One word a command, with the first line of its module as the help; the result's `run` takes it and a
    ProgressLine."""
    parser = Parser(prog="freecad_mpm", description="Multi-point five-axis machining with toroidal cutters.")
    words = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    for command in _commands():
        name, summary = str(command.__doc__).strip("`.").split("`: ")
        own = words.add_parser(name, help=summary)
        command.arguments(own)
        own.set_defaults(run=command.run)
    return parser


def _commands() -> tuple[ModuleType, ...]:
    """The modules of the commands, in the order of the list; each one's docstring is its name and what the list says."""
    try:
        from . import bench, check, cut, info, picture, plan, spins, verify
    except ImportError as error:
        raise InputError(
            f"the native modules cannot be loaded ({one_line(error)}): build them with ./dev build"
        ) from None
    return plan, info, verify, check, spins, cut, picture, bench
