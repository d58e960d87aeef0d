"""Which posts there are: each module beside this one that has FILE_ENDING, DIALECT, JOINTS, OPTIONS and
write(first, *more) is one, under its own name."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from ..base import InputError
from . import options
from .options import PostOptions

# Modules that posts share.
_NOT_POSTS = {"iso6983", "options", "program", "registry", "tnc", "writing"}


@dataclass(frozen=True)
class Post:
    """One writer of programs, and what must be known before it writes."""

    name: str
    file_ending: str  # with its dot, as the control expects it
    dialect: str  # of dialects.READERS: who reads the text back
    joints: bool  # whether it also writes joint positions, for a control without tool-centre-point control
    option_names: frozenset[str]  # those of PostOptions that it reads
    write: Callable[..., str]  # (first: Program, *more: Program): one program, each part of it with its tool

    def options(self, table: Mapping[str, Any]) -> PostOptions:
        """Raises InputError for an option that the post does not read, and for a wrong value."""
        return options.read(table, self.option_names, self.name)


def names() -> list[str]:
    """All posts."""
    return sorted(
        module.name
        for module in pkgutil.iter_modules([str(Path(__file__).parent)])
        if module.name not in _NOT_POSTS
    )


def load(name: str) -> Post:
    """The post of that name. Raises InputError naming those there are."""
    if name not in names():
        raise InputError(f"post '{name}': unknown; give one of {', '.join(names())}")
    module = import_module(f"{__package__}.{name}")
    return Post(name, module.FILE_ENDING, module.DIALECT, module.JOINTS, module.OPTIONS, module.write)
