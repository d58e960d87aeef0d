"""Where the shipped machines, tools, examples and forms are."""

from __future__ import annotations

from pathlib import Path

RESOURCES = Path(__file__).resolve().parents[3] / "resources"
TOOLS = RESOURCES / "tools"
MACHINES = RESOURCES / "machines"
EXAMPLES = RESOURCES / "examples"
FORMS = RESOURCES / "ui"
