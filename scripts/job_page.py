#!/usr/bin/python3
"""Writes the tables of keys in docs/job-file.md anew, from freecad_mpm/core/job."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from freecad_mpm.core.base import pages, write_atomically  # noqa: E402
from freecad_mpm.core.job import words  # noqa: E402

PAGE = str(ROOT / "docs/job-file.md")

write_atomically(PAGE, pages.replaced(pages.read(PAGE), {"keys": words.page_tables()}, PAGE))
