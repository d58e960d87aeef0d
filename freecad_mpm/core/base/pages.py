"""Generated blocks in pages: what stands between `<!-- begin NAME -->` and `<!-- end NAME -->`."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from .errors import InputError


def read(page: str) -> str:
    """The page's text; raises InputError naming it."""
    try:
        return Path(page).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{page}: cannot be read: {getattr(error, 'strerror', None) or error}") from None


def block(text: str, name: str) -> str | None:
    """What stands in the block, or None where the text has none of that name."""
    found = re.search(_pattern(name), text, re.DOTALL)
    return found[2].strip() if found else None


def replaced(text: str, blocks: Mapping[str, str], page: str) -> str:
    """The text with every block that it has of `blocks` replaced; raises InputError naming the page when it has none."""
    known = [name for name in blocks if block(text, name) is not None]
    if not known:
        wanted = ", ".join(f"<!-- begin {name} -->" for name in blocks)
        raise InputError(f"{page}: has none of the blocks {wanted}")
    for name in known:
        content = blocks[name]
        text = re.sub(
            _pattern(name), lambda found: f"{found[1]}\n{content}\n{found[3]}", text, flags=re.DOTALL
        )
    return text


def _pattern(name: str) -> str:
    return rf"(<!-- begin {re.escape(name)} -->)\n(.*?)(<!-- end {re.escape(name)} -->)"
