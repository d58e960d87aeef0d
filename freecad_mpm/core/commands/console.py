"""What the command line shows while it works: one line that is rewritten, on a terminal only."""

from __future__ import annotations

import sys
import time

# The line is rewritten at most this often.
REFRESH_S = 0.1
CLEAR_LINE = "\r\x1b[K"


class ProgressLine:
    """Callable as `on_progress(stage, fraction)`; `clear` before anything else is printed."""

    def __init__(self) -> None:
        self._shown = 0.0
        self._is_terminal = sys.stderr.isatty()

    def __call__(self, stage: str, fraction: float) -> None:
        now = time.monotonic()
        if self._is_terminal and (now - self._shown >= REFRESH_S or fraction == 0.0):
            self._shown = now
            sys.stderr.write(f"{CLEAR_LINE}{stage} {fraction:4.0%}")
            sys.stderr.flush()

    def say(self, line: str) -> None:
        """Print a line for good, at once: the work goes on."""
        self.clear()
        print(line, flush=True)

    def clear(self) -> None:
        """Leave an empty line for what is printed next; nothing when stderr is no terminal."""
        if self._is_terminal:
            sys.stderr.write(CLEAR_LINE)
            sys.stderr.flush()
