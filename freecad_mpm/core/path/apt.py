"""The moves as APT text, for other people's posts."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from .tool_path import ToolPath

DECIMALS = 9


def to_apt(
    path: ToolPath, name: str, radius_mm: float, corner_radius_mm: float, feeds: Mapping[str, float]
) -> str:
    """GOTO statements with tip and axis in the part's frame, mm.

    feeds: mm/min of every kind but rapid."""
    head = [f"PARTNO {name}", "UNITS/MM", f"CUTTER/{2 * radius_mm:.4f},{corner_radius_mm:.4f}", "MULTAX/ON"]
    rows = (np.round(np.hstack((path.tip, path.axis)), DECIMALS) + 0.0).tolist()
    return "\n".join([*head, *_apt_moves(path.kind.tolist(), rows, feeds), "FINI", ""])


def _apt_moves(
    kinds: Sequence[str], rows: Sequence[Sequence[float]], feeds: Mapping[str, float]
) -> Iterator[str]:
    template = "GOTO/" + ",".join([f"%.{DECIMALS}f"] * 6)
    feed = None
    for kind, row in zip(kinds, rows):
        if kind == "rapid":
            yield "RAPID"
        elif feeds[kind] != feed:
            feed = feeds[kind]
            yield f"FEDRAT/{feed:g},MMPM"
        yield template % tuple(row)
