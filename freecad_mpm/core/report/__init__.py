"""Is it good: the verdict, warnings, facts, words for people, the statement at the end.

"Proven" is said only of what was.
To add a reason why a plan is not good: one row in `verdict.judge`, with a test that provokes it."""

from __future__ import annotations

from . import facts, text
from .facts import with_cut
from .verdict import judge

__all__ = ["facts", "judge", "text", "with_cut"]
