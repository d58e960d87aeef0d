"""What a post may be asked for besides the moves: the keys of a job's [post] options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, ClassVar

from ..base import InputError, Table, choice, flag, key, not_negative, positive, whole


@dataclass(frozen=True, kw_only=True)
class PostOptions(Table):
    """Each post reads some of them and names those in its OPTIONS."""

    table: ClassVar[str] = "post.options"

    decimals: int = key(whole(3, 9), 4)  # of lengths and angles; the controls' finest step is 0.0001 of most
    comments: bool = key(flag, True)
    blank: bool = key(flag, True)  # the blank form, for the control's picture
    coolant: str = key(choice("flood", "mist", "off"), "flood")
    tool_change: bool = key(flag, False)  # M6 with the tool call, where the call alone does not change it
    retract: str = key(
        choice("machine", "tool_axis"), "machine"
    )  # tool_axis: M140 before the machine's own Z
    preposition_mm: float = key(positive("mm"), 100.0)  # over the first pose, where the tool first turns
    path_tolerance_mm: float = key(not_negative("mm"), 0.0)  # that the control may smooth by; 0: not written
    rotary_tolerance_deg: float = key(
        not_negative("degrees"), 0.05
    )  # of its rotary axes, with path_tolerance_mm
    smoothing: str = key(choice("finish", "rough"), "finish")  # what it prefers: accuracy or speed
    end_block: int = key(whole(1000, 99_999_999), 999_999)  # TNC 426/430; 99999999 on later ones
    program_number: int = key(whole(1, 9999), 1)

    @property
    def coolant_word(self) -> str:
        """M8, M7, or nothing."""
        return {"flood": "M8", "mist": "M7", "off": ""}[self.coolant]


NAMES = tuple(one.name for one in fields(PostOptions))
# What every post reads but the one for other people's posts.
COMMON = frozenset({"decimals", "comments", "coolant", "preposition_mm"})


def read(table: Mapping[str, Any], known: frozenset[str], post: str) -> PostOptions:
    """The options of a table. Raises InputError for one that the post does not read, and for a wrong value."""
    for name in table:
        if name in NAMES and name not in known:
            raise InputError(
                f"[post.options] {name}: the post {post} has no use for it; it reads {_list(known)}"
            )
    return PostOptions.from_table(table)


def _list(known: frozenset[str]) -> str:
    return ", ".join(name for name in NAMES if name in known) or "none"
