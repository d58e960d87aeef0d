"""What is asked for: the tables of a job file as frozen dataclasses, the tool, and how the tolerances are shared out.

It opens without the native module, as documents must.
To add a key: one line in `tables.py` with its check, default and words; one in `document/properties.py`; one where it
is used. `scripts/job_page.py` then writes docs/job-file.md anew."""

from __future__ import annotations

from . import budget, tool, words
from .budget import (
    PROVEN,
    WORD_SLACK,
    certified_depth_mm,
    control_deviation_deg,
    control_tip_deviation_mm,
    cut_depth_mm,
)
from .file import dump, load
from .tables import (
    ACROSS,
    DEFAULT_MACHINE,
    DEFAULT_METHOD,
    DEFAULT_POST,
    DIRECT,
    KEYS,
    SECTIONS,
    FootprintSpec,
    Job,
    LinkSpec,
    MachineSpec,
    MethodSpec,
    Part,
    PostSpec,
    Setup,
    Tolerance,
)
from .tool import Segment, ToolSpec

__all__ = [
    "ACROSS",
    "DEFAULT_MACHINE",
    "DEFAULT_METHOD",
    "DEFAULT_POST",
    "DIRECT",
    "FootprintSpec",
    "Job",
    "KEYS",
    "LinkSpec",
    "MachineSpec",
    "MethodSpec",
    "PROVEN",
    "Part",
    "PostSpec",
    "SECTIONS",
    "Segment",
    "Setup",
    "Tolerance",
    "ToolSpec",
    "WORD_SLACK",
    "budget",
    "certified_depth_mm",
    "control_deviation_deg",
    "control_tip_deviation_mm",
    "cut_depth_mm",
    "dump",
    "load",
    "tool",
    "words",
]
