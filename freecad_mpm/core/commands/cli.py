"""The command line `python3 -m freecad_mpm` (docs/command-line.md)."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from types import ModuleType
from typing import NoReturn

from ..base import Cancelled, InputError, one_line
from .console import ProgressLine

BAD_INPUT = 2
INTERRUPTED, BROKEN_PIPE = 130, 141  # as shells report Ctrl-C, and a reader that has gone

# Word -> what the list of commands says of it. Each is the module of that name beside this one.
COMMANDS = {
    "plan": "compute a job: positions, path, program, report",
    "info": "list the faces of a part",
    "verify": "judge the poses of a CL file against a job's part and tool",
    "check": "read a program's text as its control would and check it",
    "spins": "all spins over some points: contacts, spacing, strip width",
    "cut": "cut a plan, a CL file or a program into the stock and measure what is left",
    "picture": "draw tool and machine at chosen positions of a job's path",
    "bench": "compare the methods and write bench.json",
}


class Parser(argparse.ArgumentParser):
    """Bad arguments get one line and status 2, like all bad input."""

    def error(self, message: str) -> NoReturn:
        """Called by argparse; never returns."""
        self.exit(BAD_INPUT, f"{self.prog}: {one_line(message)}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status; bad input is one line on stderr."""
    progress = ProgressLine()
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        parsed = make_parser(*given[:1]).parse_args(given)
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


def make_parser(chosen: str = "") -> Parser:
    """The parser of all words, with the arguments of the chosen one: no other command is loaded."""
    parser = Parser(prog="freecad_mpm", description="Multi-point five-axis machining with toroidal cutters.")
    words = parser.add_subparsers(required=True, metavar="COMMAND", parser_class=Parser)
    for word, summary in COMMANDS.items():
        own = words.add_parser(word, help=summary)
        if word == chosen:
            command = _load(word)
            command.arguments(own)
            own.set_defaults(run=command.run)
    return parser


def _load(word: str) -> ModuleType:
    try:
        return import_module(f"{__package__}.{word}")
    except ImportError as error:
        raise InputError(
            f"the native modules cannot be loaded ({one_line(error)}): build them with ./dev build"
        ) from None
