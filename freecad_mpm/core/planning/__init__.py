"""The façade: `plan(job) -> Plan` runs the stages in order; a script can run any stage alone.

Each stage is a call that takes and returns arrays; nothing heavy happens here.
To add a stage: a function of the room that it belongs to, and one line in `planning.py`."""

from __future__ import annotations

from .planning import plan
from .result import Plan

__all__ = ["Plan", "plan"]
