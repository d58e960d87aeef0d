"""Running the stages of a plan: timed, watched for progress, and stopped by a cancel or Ctrl-C."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, ParamSpec, Protocol, TypeVar

from .errors import Cancelled

if TYPE_CHECKING:
    from ... import _core

T = TypeVar("T")
P = ParamSpec("P")

# How often a running stage is looked at: half of the 0.1 s within which a cancel must stop it.
POLL_S = 0.05


class Event(Protocol):
    """What `threading.Event` has."""

    def is_set(self) -> bool:
        """Asked every POLL_S seconds while a stage runs; True stops it."""


Progress = Callable[[str, float], None]
Cancel = Event | Callable[[], bool]


class Stages:
    """Runs one stage after the other and keeps their wall times in `seconds` (stage name -> s).

    `on_progress(stage, fraction)` and `cancel` are called in the caller's thread; when `cancel` says so the stage ends
    within 0.1 s and Cancelled is raised. `threads` is the number the native stages may use, 0: all cores."""

    def __init__(
        self, on_progress: Progress | None = None, cancel: Cancel | None = None, threads: int = 0
    ) -> None:
        self.seconds: dict[str, float] = {}
        self._on_progress = on_progress or (lambda stage, fraction: None)
        self._is_cancelled = _as_function(cancel)
        self._threads = threads

    def run(self, stage: str, function: Callable[P, T], *arguments: P.args, **named: P.kwargs) -> T:
        """A short call, in this thread: it is not interrupted."""
        with self._timed(stage):
            return function(*arguments, **named)

    def run_native(self, stage: str, function: Callable[..., T], *arguments: Any, **named: Any) -> T:
        """A native call with a `context` argument, through which it reports progress and is stopped."""
        from ... import _core  # not before: `base` opens without the native module

        context = _core.Context(self._threads)
        with self._timed(stage), ThreadPoolExecutor(max_workers=1) as worker:
            # A Ctrl-C may come at any moment from here on; the worker must not be waited for without being cancelled.
            try:
                future = worker.submit(function, *arguments, context=context, **named)
                while not wait([future], POLL_S).done:
                    self._look_up(stage, context)
            except BaseException:
                context.cancel()
                raise
            return future.result()

    @contextmanager
    def _timed(self, stage: str) -> Iterator[None]:
        self._check()
        self._on_progress(stage, 0.0)
        started = time.perf_counter()
        yield
        self.seconds[stage] = self.seconds.get(stage, 0.0) + time.perf_counter() - started
        self._on_progress(stage, 1.0)
        self._check()

    def _look_up(self, stage: str, context: _core.Context) -> None:
        if context.total:
            self._on_progress(stage, min(context.done / context.total, 1.0))
        self._check()

    def _check(self) -> None:
        if self._is_cancelled():
            raise Cancelled()


def _as_function(cancel: Cancel | None) -> Callable[[], bool]:
    if cancel is None:
        return lambda: False
    return cancel if callable(cancel) else cancel.is_set
