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
    """Put `where`, e.g. "job.toml: [footprint]", in front of any ValueError and make it an InputError: the native core
    names only the argument, and a part of the program only what it was given."""
    try:
        yield
    except ValueError as error:
        raise InputError(f"{where} {one_line(error)}") from None


def one_line(error: object) -> str:
    """The text of an error without line breaks, as the last line of a terminal shows it."""
    return " ".join(str(error).split())
