"""What can stop a plan, apart from bugs."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


class InputError(ValueError):
    """A caller's mistake, in one line: the file or argument, what is wrong, what would be right."""


class Cancelled(Exception):
    """The plan was stopped by its `cancel` argument before it was done."""


@contextmanager
def blame(where: str) -> Iterator[None]:
    """Turn a ValueError of the native core, which names only the argument, into an InputError that says whose it is.

    `where` is put in front of the message, e.g. "job.toml: [footprint]"; an InputError passes unchanged."""
    try:
        yield
    except InputError:
        raise
    except ValueError as error:
        raise InputError(f"{where} {one_line(error)}") from None


def one_line(error: object) -> str:
    """The text of an error without line breaks, as the last line of a terminal shows it."""
    return " ".join(str(error).split())
