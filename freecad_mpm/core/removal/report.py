"""What a cut found, as facts and as lines of text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..base import Floats
from .cutting import Cut, Extreme
from .section import Section

BINS = 20
PERCENTILES = (0.1, 1, 50, 99, 99.9)


def facts(
    cut: Cut, sections: Mapping[str, tuple[Section, Floats | None]], program_block: Any = None
) -> dict[str, Any]:
    """Everything as plain numbers. sections: name -> the section, and what a probe finds of it or None; program_block:
    (M,) numbers of the program's blocks, when the path is a program's."""
    values, worst = cut.deviation.deviation_mm, cut.worst()
    counts, edges = np.histogram(values, BINS)
    return {
        "resolution_mm": cut.resolution_mm,
        "stock_box_setup_mm": [cut.stock.lo.tolist(), cut.stock.hi.tolist()],
        "volume_left_mm3": None if cut.dexels is None else cut.dexels.volume_mm3,
        "points": len(values),
        "worst_gouge": _extreme(cut, worst.gouge, program_block)
        | {"depth_mm": float(cut.depth_mm(worst.gouge.point[None])[0])},
        "largest_remainder": _extreme(cut, worst.remainder, program_block),
        "check_faces": {
            "points": cut.overcut.looked_at,
            "deepest": worst.check
            and _extreme(cut, worst.check, program_block) | {"face": _deepest_face(cut)},
        },
        "gouges_measured_down_to_mm": -cut.below_mm,
        "percentiles_mm": {f"{p:g}": float(np.percentile(values, p)) for p in PERCENTILES},
        "histogram": {"edges_mm": edges.tolist(), "points": counts.tolist()},
        "sections": {name: _section(one, by_probe) for name, (one, by_probe) in sections.items()},
        "seconds": dict(cut.seconds),
    }


def _extreme(cut: Cut, extreme: Extreme, program_block: Any) -> dict[str, Any]:
    found: dict[str, Any] = {
        "deviation_mm": extreme.deviation_mm,
        "point": extreme.point.tolist(),
        "move": extreme.move,
        "kind": str(cut.path.kind[extreme.move]) if extreme.move >= 0 else None,
    }
    for name in ("position", "pass_index", "line"):
        rows = getattr(cut.path, name, None)
        if rows is not None and extreme.move >= 0:
            found[name] = int(rows[extreme.move])
    if program_block is not None and extreme.move >= 0:
        found["block"] = int(program_block[extreme.move])
    return found


def _deepest_face(cut: Cut) -> str:
    found = cut.overcut
    return str(cut.scene.check[found.face[int(np.argmax(found.depth_mm))]].name)


def _section(one: Section, by_probe: Floats | None) -> dict[str, Any]:
    found = {
        "origin": one.plane.origin.tolist(),
        "normal": one.plane.normal.tolist(),
        "points": len(one.points),
        "pieces": int(one.piece[-1]) + 1,
        **_range(one, one.deviation_mm, ""),
    }
    return found if by_probe is None else found | _range(one, by_probe, "probed_")


def _range(one: Section, values: Floats, prefix: str) -> dict[str, Any]:
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    return {
        f"{prefix}min_mm": float(values[low]),
        f"{prefix}min_at": one.points[low].tolist(),
        f"{prefix}max_mm": float(values[high]),
        f"{prefix}max_at": one.points[high].tolist(),
    }


def text(found: dict[str, Any]) -> str:
    """The facts for people."""
    lines = [*worst_lines(found)]
    lines.append(
        "Deviation, mm: "
        + ", ".join(f"{p} % below {value:.4f}" for p, value in found["percentiles_mm"].items())
    )
    if found["volume_left_mm3"] is not None:
        lines.append(f"Stock left: {found['volume_left_mm3']:.1f} mm3")
    lines += [_section_line(name, one) for name, one in found["sections"].items()]
    lines.append(
        "Time: " + ", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in found["seconds"].items())
    )
    return "\n".join(lines) + "\n"


def worst_lines(found: dict[str, Any]) -> list[str]:
    """The worst places, for people."""
    return [
        f"Cut into stock, {found['points']} points of the faces, every {found['resolution_mm']:g} mm",
        f"Worst gouge: {_where(found['worst_gouge'])}; {found['worst_gouge']['depth_mm']:.4f} mm inside the tool",
        f"Largest remainder: {_where(found['largest_remainder'])}",
        _check_line(found["check_faces"]),
    ]


def _check_line(found: dict[str, Any]) -> str:
    deepest, points = found["deepest"], found["points"]
    if deepest is None:
        return (
            f"Check faces: none is cut, at {points} points near the path"
            if points
            else "Check faces: none is near"
        )
    return f"Check faces: deepest in {deepest['face']}, {_where(deepest)}"


def _where(extreme: dict[str, Any]) -> str:
    x, y, z = extreme["point"]
    at = f"{extreme['deviation_mm']:+.4f} mm at {x:.3f} {y:.3f} {z:.3f}"
    if extreme["move"] < 0:
        return f"{at}, where no move cut"
    names = {"pass_index": "pass", "position": "position", "line": "line", "block": "block"}
    details = [f"{name} {extreme[key]}" for key, name in names.items() if extreme.get(key, -1) >= 0]
    return f"{at}, after move {extreme['move']} ({', '.join([extreme['kind'], *details])})"


def _section_line(name: str, one: dict[str, Any]) -> str:
    line = f"Section {name}: {one['min_mm']:+.4f} to {one['max_mm']:+.4f} mm over {one['points']} points"
    if "probed_min_mm" in one:
        line += f", by probe {one['probed_min_mm']:+.4f} to {one['probed_max_mm']:+.4f} mm"
    return line


def to_json(found: dict[str, Any]) -> str:
    return json.dumps(found, indent=2, allow_nan=False) + "\n"
