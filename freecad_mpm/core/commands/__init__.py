"""The command line, one file a command: its arguments and what it does; status 0 good, 1 not good, 2 bad input.

    python3 -m freecad_mpm COMMAND …        main(["plan", "job.toml", "--out", "out"])

To add a command: one file with `arguments` and `run`, its row in `cli.COMMANDS`, one section in docs/command-line.md."""

from __future__ import annotations

from .cli import main

__all__ = ["main"]
