"""The parts that several tests read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "resources" / "examples"
DATA = ROOT / "tests" / "data"
SHARED_DATA = Path(os.environ.get("MPM_SHARED_DATA", ROOT.parent / "shared" / "data"))
# The thesis' cutter without shank and holder, for a job's text.
TOOL = """[tool]
major_radius_mm = 6.7
minor_radius_mm = 6.0
recess_mm = 6.0
"""


def shared(name: str) -> Path:
    """A part that does not belong to the project; the test is skipped when it is not there."""
    path = SHARED_DATA / name
    if not path.is_file():
        pytest.skip(f"{path} is not there (set MPM_SHARED_DATA to the folder of the shared parts)")
    return path
