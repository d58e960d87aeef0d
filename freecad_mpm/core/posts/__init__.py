"""Posts: each module of this package that has FILE_ENDING, DIALECT and write(program) is one, under its own name."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module

from ..errors import InputError
from .program import Program

# Modules that posts share.
_NOT_POSTS = {"program", "writing"}


@dataclass(frozen=True)
class Post:
    name: str
    file_ending: str  # with its dot, as the control expects it
    dialect: str  # of dialects.READERS: who reads the text back
    write: Callable[[Program], str]


def names() -> list[str]:
    """All posts."""
    return sorted(module.name for module in pkgutil.iter_modules(__path__) if module.name not in _NOT_POSTS)


def load(name: str) -> Post:
    """The post of that name. Raises InputError naming those there are."""
    if name not in names():
        raise InputError(f"post '{name}': unknown; give one of {', '.join(names())}")
    module = import_module(f"{__name__}.{name}")
    return Post(name, module.FILE_ENDING, module.DIALECT, module.write)
