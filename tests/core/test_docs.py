"""What docs/ says of the job file and of cl.csv is so."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

from freecad_mpm.core import job
from freecad_mpm.core.job import Job, Part, ToolSpec
from freecad_mpm.core.path import cl_file

DOCS = Path(__file__).resolve().parents[2] / "docs"


def test_the_documented_job_file_holds_every_key_with_its_default(tmp_path: Path) -> None:
    text = re.search(r"```toml\n(.*?)```", (DOCS / "job-file.md").read_text(), re.DOTALL)
    assert text
    (tmp_path / "job.toml").write_text(text[1])
    documented = job.load(tmp_path / "job.toml")
    tool = ToolSpec(6.7, 6.0, 6.0, 40.0, documented.tool.shank)
    part = Part(str(tmp_path / "saddle.step"), ("Face1",))
    assert documented == Job(part=part, tool=tool)
    keys = "\n" + text[1]
    for line in job.dump(replace(documented, tool=tool)).splitlines():
        key = line.split(" = ")[0]
        assert key == "name" or f"\n{key}" in keys, f"{key} is not documented"


def test_the_documented_header_is_ours() -> None:
    assert cl_file.HEADER in (DOCS / "command-line.md").read_text()
