"""Files appear whole or not at all: written under a temporary name beside the target, then renamed."""

from __future__ import annotations

import os
import secrets
from collections.abc import Mapping
from pathlib import Path

from .errors import InputError


def write_atomically(path: str | Path, data: bytes | str) -> None:
    """Write `data` (text as UTF-8) to `path`, replacing what was there; after an error the old file is untouched.

    Raises InputError naming the folder when it cannot be written."""
    write_together(Path(path).parent, {Path(path).name: data})


def write_together(folder: str | Path, files: Mapping[str, bytes | str]) -> list[Path]:
    """Write several files to `folder`, made when missing: all are complete under temporary names before the first
    is renamed. Returns their paths. Raises InputError naming `folder` when it cannot be written."""
    check_folder(folder)
    folder = Path(folder)
    temporary = {name: folder / f".{name}.{secrets.token_hex(4)}" for name in files}
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, data in files.items():
            with open(temporary[name], "xb") as file:
                file.write(data.encode() if isinstance(data, str) else data)
        for name in files:
            os.replace(temporary[name], folder / name)
    except OSError as error:
        raise InputError(f"{folder}: cannot be written: {error.strerror or error}") from None
    finally:
        for path in temporary.values():
            path.unlink(missing_ok=True)
    return [folder / name for name in files]


def check_folder(folder: str | Path) -> None:
    """Raise InputError naming `folder` unless it is, or can become, a folder to write to: asked before long work."""
    existing = Path(folder).absolute()
    while not os.path.lexists(existing):
        existing = existing.parent
    if not existing.is_dir():
        raise InputError(f"{folder}: must be a folder, but {existing} is not one")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise InputError(f"{folder}: cannot be written: no permission to write to {existing}")
