"""Jobs over the thesis' saddle: a coarse one, which takes well under a second."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from part_samples import TOOL

JOB = """
[part]
file = "{part}"

{tool}
[footprint]
side_step_mm = 50.0
forward_step_mm = 25.0
allow_gaps = true

[method]
name = "vcrf"

[tolerance]
gouge_mm = 0.02
chord_mm = 2.0
"""


@pytest.fixture
def job_text(thesis_part: Callable[[str], Path]) -> str:
    """A job file's text that is good as it stands: 4 passes of 7 positions."""
    return JOB.format(tool=TOOL, part=thesis_part("saddle"))


@pytest.fixture
def job_file(tmp_path: Path, job_text: str) -> Path:
    path = tmp_path / "job.toml"
    path.write_text(job_text)
    return path
