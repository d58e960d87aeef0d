"""Measures for tests of speed that hold on any processor: against work that everybody knows."""

from __future__ import annotations

import time
from collections.abc import Callable


def worked_s(call: Callable[[], object]) -> float:
    """Processor time (s) of a call: the least of three, for what else the computer does only adds to it."""

    def once() -> float:
        started = time.process_time()
        call()
        return time.process_time() - started

    return min(once() for _ in range(3))


def formatting_s(count: int) -> float:
    """Processor time (s) in which Python makes text of so many numbers, one by one."""
    return worked_s(lambda: [f"{0.1 * number:.3f}" for number in range(count)])
