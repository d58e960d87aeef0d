"""The command line as a user runs it."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Only what will never end takes so long, on a loaded machine too.
LIMIT_S = 600.0


def start(*arguments: object, stderr: int = subprocess.PIPE) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "freecad_mpm", *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        text=True,
        stdout=subprocess.PIPE,
        stderr=stderr,
        preexec_fn=listen_to_ctrl_c,
    )


def listen_to_ctrl_c() -> None:
    """Also when the tests run in the background, where shells switch Ctrl-C off."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def run(*arguments: object) -> tuple[int, str, str]:
    """Exit status, stdout, stderr."""
    process = start(*arguments)
    out, error = process.communicate(timeout=LIMIT_S)
    return process.returncode, out, error
