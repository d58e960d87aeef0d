"""Is it good: the verdict, warnings, facts, words for people, the statement at the end.

"Proven" is said only of what was.
To add a reason why a plan is not good: one row in `verdict.judge`, with a test that provokes it."""

from __future__ import annotations

from .report import Report, make_report, with_cut
from .text import text, to_json
from .verdict import Verdict, judge

__all__ = ["Report", "Verdict", "judge", "make_report", "text", "to_json", "with_cut"]
