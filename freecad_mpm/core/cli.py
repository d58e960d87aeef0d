"""The command line `python3 -m freecad_mpm` (docs/command-line.md)."""

from __future__ import annotations

import argparse
import math
import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from . import planes
from .console import ProgressLine
from .errors import Cancelled, InputError, one_line

BAD_INPUT = 2
INTERRUPTED, BROKEN_PIPE = 130, 141  # as shells report Ctrl-C, and a reader that has gone

Command = Callable[[argparse.Namespace, ProgressLine], int]


class Parser(argparse.ArgumentParser):
    """Bad arguments get one line and status 2, like all bad input."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"{self.prog}: {one_line(message)}; see {self.prog} --help\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit status; bad input is one line on stderr."""
    parsed = make_parser().parse_args(arguments)
    progress = ProgressLine()
    try:
        status = run(parsed, progress)
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


def run(parsed: argparse.Namespace, progress: ProgressLine) -> int:
    try:
        from . import commands
    except ImportError as error:
        raise InputError(
            f"the native modules cannot be loaded ({one_line(error)}): build them with ./dev build"
        )
    command: Command = getattr(commands, parsed.function or parsed.command)
    return command(parsed, progress)


def make_parser() -> Parser:
    parser = Parser(prog="freecad_mpm", description="Multi-point five-axis machining with toroidal cutters.")
    parser.set_defaults(function="")  # a command's own, where a module has its name already
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=Parser)

    plan = commands.add_parser("plan", help="compute a job: positions, path, program, report")
    plan.add_argument("job", metavar="JOB.toml")
    plan.add_argument("--out", metavar="DIR", required=True, help="folder for the results, made when missing")
    plan.add_argument(
        "--proof",
        action="store_true",
        help="also write a program that shows whether the machine file is right",
    )
    _add_threads(plan)

    info = commands.add_parser("info", help="list the faces of a part")
    info.add_argument("file", metavar="FILE", help="STEP, IGES, BREP or Bézier text")

    verify = commands.add_parser("verify", help="judge the poses of a CL file against a job's part and tool")
    verify.add_argument("job", metavar="JOB.toml")
    verify.add_argument("cl_file", metavar="cl.csv")
    _add_threads(verify)

    check = commands.add_parser("check", help="read a program's text as its control would and check it")
    check.add_argument("program", metavar="PROGRAM")
    check.add_argument("--machine", metavar="NAME", required=True, help="a shipped machine or its file")
    check.add_argument("--post", metavar="NAME", help="whose dialect it is; default: the one it looks like")
    check.add_argument(
        "--joints", action="store_true", help="it moves the joints: no tool-centre-point control"
    )
    check.add_argument("--against", metavar="cl.csv", help="poses that the program must meet in their order")

    spins = commands.add_parser("spins", help="all spins over some points: contacts, spacing, strip width")
    spins.add_argument("job", metavar="JOB.toml")
    spins.add_argument("--out", metavar="DIR", required=True, help="folder for spins.csv and the pictures")
    spins.add_argument(
        "--at",
        metavar="X,Y",
        nargs="+",
        type=_point,
        default=[],
        help="footprint points in the set-up frame, mm; default: five of the job's footprint",
    )
    spins.add_argument(
        "--step-deg", metavar="A", type=_positive, default=5.0, help="from spin to spin; default: 5"
    )
    spins.add_argument(
        "--scallop-mm", metavar="H", type=_positive, default=0.05, help="of the strip; default: 0.05"
    )
    spins.set_defaults(function="spins_of")
    _add_threads(spins)

    cut = commands.add_parser(
        "cut", help="cut a plan, a CL file or a program into the stock and measure what is left"
    )
    cut.add_argument("job", metavar="JOB.toml")
    cut.add_argument("program", metavar="PROGRAM|cl.csv", nargs="?", help="default: the job is planned")
    cut.add_argument("--out", metavar="DIR", required=True, help="folder for the results, made when missing")
    cut.add_argument(
        "--resolution-mm",
        metavar="MM",
        type=_positive,
        default=0.5,
        help="between dexels and points; default: 0.5",
    )
    cut.add_argument(
        "--box", metavar="MM", type=float, nargs=6, help="only there: lo x y z, hi x y z, set-up frame"
    )
    cut.add_argument(
        "--section",
        metavar="PLANE",
        action="append",
        help=f"{planes.FORMS}, part frame; may be given several times",
    )
    cut.add_argument(
        "--probe-radius-mm", metavar="MM", type=_positive, help="measure the sections with such a ball, too"
    )
    cut.add_argument(
        "--mesh", metavar="NAME", default="machined.stl", help="the stock's file: .stl, .ply or .obj"
    )
    cut.add_argument("--machine", metavar="NAME", help="that makes the program's moves; default: the job's")
    cut.add_argument(
        "--post", metavar="NAME", help="whose dialect the program is; default: the one it looks like"
    )
    _add_threads(cut)

    picture = commands.add_parser("picture", help="draw tool and machine at chosen positions of a job's path")
    picture.add_argument("job", metavar="JOB.toml")
    picture.add_argument(
        "--position", metavar="N", nargs="+", type=_position, required=True, help="in machining order, from 1"
    )
    picture.add_argument("--out", metavar="DIR", default="out", help="folder for the pictures; default: out")
    _add_threads(picture)

    bench = commands.add_parser("bench", help="compare the methods and write bench.json")
    bench.add_argument(
        "--surfaces", nargs="+", metavar="NAME", help="shipped examples or job files; default: thesis"
    )
    bench.add_argument("--methods", nargs="+", metavar="NAME", help="default: all")
    bench.add_argument(
        "--published",
        action="store_true",
        help="instead: the thesis' tables 2 and 3, its figures beside ours",
    )
    bench.add_argument("--out", metavar="DIR", default="out", help="folder for bench.json; default: out")
    bench.add_argument("--csv", metavar="FILE", help="also write the rows to this file in --out, as CSV")
    bench.add_argument(
        "--scaling",
        action="store_true",
        help="instead: how exact's time grows with positions, size, tolerance",
    )
    bench.add_argument(
        "--markdown",
        metavar="PAGE",
        nargs="+",
        default=[],
        help="pages whose generated tables are written anew",
    )
    _add_threads(bench)
    return parser


def _add_threads(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--threads", metavar="N", type=_threads, default=0, help="0, the default: all cores")


def _point(text: str) -> tuple[float, float]:
    try:
        x, y = (float(one) for one in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be X,Y such as 75,40, got '{text}'") from None
    if not (math.isfinite(x) and math.isfinite(y)):
        raise argparse.ArgumentTypeError(f"must be two finite numbers, got '{text}'")
    return x, y


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0 < value < math.inf:
        raise argparse.ArgumentTypeError(f"must be a positive number, got '{text}'")
    return value


def _position(text: str) -> int:
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"must be a whole number from 1, got '{text}'")
    return int(text)


def _threads(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"must be a whole number from 0, got '{text}'")
    return int(text)
