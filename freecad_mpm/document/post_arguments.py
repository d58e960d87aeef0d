"""The arguments of a post in FreeCAD's words, as CAM's own posts have them, to those of the core."""

from __future__ import annotations

import argparse
import shlex
from dataclasses import dataclass
from typing import Any, NoReturn

from ..core.base import InputError, one_line


@dataclass(frozen=True)
class PostArguments:
    """What was asked for; options that were not given are not in it, so that the job's hold."""

    tcp: bool
    options: dict[str, Any]  # of PostOptions


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise InputError(f"post arguments: {one_line(message)}; there are {', '.join(_names())}")


def parse(text: str) -> PostArguments:
    """Raises InputError for an argument that there is not."""
    given = vars(_parser().parse_args(shlex.split(text or "")))
    tcp = not given.pop("no_tcp")
    given.pop("show_editor")
    if given.pop("inches"):
        raise InputError("post arguments: --inches: these posts write millimetres only")
    axis_decimals = given.pop("axis_precision")
    if axis_decimals is not None:
        given["decimals"] = axis_decimals
    return PostArguments(tcp, {name: value for name, value in given.items() if value is not None})


def help_text() -> str:
    """As argparse prints it: what CAM shows as the tip of the arguments."""
    return _parser().format_help()


def _names() -> list[str]:
    return [one.option_strings[0] for one in _parser()._actions]


def _parser() -> _Parser:
    parser = _Parser(prog="", usage="post arguments", add_help=False, allow_abbrev=False)
    add = parser.add_argument
    for off, on, name, what in (
        ("--no-comments", "--comments", "comments", "comments"),
        ("--no-header", "--header", "comments", "the same: a header is a comment"),
        ("--no-blank", "--blank", "blank", "the blank form, for the control's picture"),
    ):
        add(off, dest=name, action="store_false", default=None, help=f"without {what}")
        add(on, dest=name, action="store_true", default=None, help=f"with {what}; the default")
    add(
        "--no-show-editor",
        dest="show_editor",
        action="store_false",
        help="taken and ignored: no editor is shown",
    )
    add("--show-editor", dest="show_editor", action="store_true", help=argparse.SUPPRESS)
    add("--metric", dest="inches", action="store_false", default=False, help="millimetres; the only unit")
    add("--inches", dest="inches", action="store_true", help=argparse.SUPPRESS)
    add("--precision", dest="decimals", type=int, metavar="N", help="decimals of lengths and angles")
    add("--axis-precision", type=int, metavar="N", help="the same; wins over --precision")
    add("--no-tcp", action="store_true", help="joint positions, for a control that does not hold the tip")
    add(
        "--path-tolerance",
        dest="path_tolerance_mm",
        type=float,
        metavar="MM",
        help="Cycle 32, CYCLE832, G64 P",
    )
    add("--rotary-tolerance", dest="rotary_tolerance_deg", type=float, metavar="DEG", help="TA of Cycle 32")
    add("--smoothing", choices=("finish", "rough"), help="HSC mode of Cycle 32")
    add("--retract", choices=("machine", "tool_axis"), help="at the end: tool_axis writes M140 first")
    add("--tool-change", action="store_true", default=None, help="M6 with the tool call (DIN/ISO)")
    add("--end-block", type=int, metavar="N", help="number of the last block (DIN/ISO)")
    add("--program-number", type=int, metavar="N", help="O number (Fanuc)")
    return parser
