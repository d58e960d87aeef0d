"""What a cut found, as data, and as lines of text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from ..base import Floats, Integers
from .cutting import Cut, Extreme
from .section import Section

BINS = 20
PERCENTILES = (0.1, 1, 50, 99, 99.9)
# What of a move is told, where its path knows it, and in which words.
DETAILS = {"pass_index": "pass", "position": "position", "line": "line", "block": "block"}


@dataclass(frozen=True)
class Place:
    """A place of the deviation (mm, part frame) and the move that cut there last, -1: none did."""

    deviation_mm: float
    point: list[float]
    move: int
    kind: str | None
    details: Mapping[str, int]  # of the move, by names of DETAILS
    depth_mm: float | None = None  # how deep the point lay inside the tool
    face: str | None = None

    @classmethod
    def of(cls, cut: Cut, extreme: Extreme, block: Integers | None, **more: Any) -> Place:
        """block: (M,) numbers of the program's blocks, when the path is a program's."""
        move = extreme.move
        columns = {name: getattr(cut.path, name, None) for name in DETAILS} | {"block": block}
        details = {name: int(rows[move]) for name, rows in columns.items() if rows is not None and move >= 0}
        kind = str(cut.path.kind[move]) if move >= 0 else None
        return cls(extreme.deviation_mm, extreme.point.tolist(), move, kind, details, **more)

    def to_dict(self) -> dict[str, Any]:
        """For JSON; what is not known of a place is left out."""
        own = {name: value for name, value in vars(self).items() if name != "details"}
        unknown = {name for name in ("depth_mm", "face") if own[name] is None}
        return {name: value for name, value in own.items() if name not in unknown} | dict(self.details)

    def words(self) -> str:
        """Deviation and point in mm, part frame, and the move that cut there."""
        x, y, z = self.point
        at = f"{self.deviation_mm:+.4f} mm at {x:.3f} {y:.3f} {z:.3f}"
        if self.move < 0:
            return f"{at}, where no move cut"
        details = [f"{DETAILS[name]} {value}" for name, value in self.details.items() if value >= 0]
        return f"{at}, after move {self.move} ({', '.join([str(self.kind), *details])})"


@dataclass(frozen=True)
class SectionFigures:
    """Least and largest deviation along a section, and what a probe makes of them."""

    origin: list[float]
    normal: list[float]
    points: int
    pieces: int
    machined: Mapping[str, Any]
    probed: Mapping[str, Any] | None

    @classmethod
    def of(cls, one: Section, by_probe: Floats | None) -> SectionFigures:
        """by_probe: deviations that a ball probe would measure along it, mm; None: not probed."""
        return cls(
            one.plane.origin.tolist(),
            one.plane.normal.tolist(),
            len(one.points),
            int(one.piece[-1]) + 1,
            _range(one, one.deviation_mm),
            None if by_probe is None else _range(one, by_probe),
        )

    def to_dict(self) -> dict[str, Any]:
        """For JSON; the probe's figures have names that begin with `probed_`."""
        own = {name: value for name, value in vars(self).items() if name not in ("machined", "probed")}
        probed = {f"probed_{name}": value for name, value in (self.probed or {}).items()}
        return own | dict(self.machined) | probed

    def words(self, name: str) -> str:
        """One line: least and largest deviation, mm."""
        low, high = self.machined["min_mm"], self.machined["max_mm"]
        line = f"Section {name}: {low:+.4f} to {high:+.4f} mm over {self.points} points"
        if self.probed is not None:
            line += f", by probe {self.probed['min_mm']:+.4f} to {self.probed['max_mm']:+.4f} mm"
        return line


def _range(one: Section, values: Floats) -> dict[str, Any]:
    low, high = int(np.nanargmin(values)), int(np.nanargmax(values))
    return {
        "min_mm": float(values[low]),
        "min_at": one.points[low].tolist(),
        "max_mm": float(values[high]),
        "max_at": one.points[high].tolist(),
    }


@dataclass(frozen=True)
class CutReport:
    """What is told of a cut."""

    resolution_mm: float
    stock_box_setup_mm: list[list[float]]
    volume_left_mm3: float | None
    points: int
    worst_gouge: Place
    largest_remainder: Place
    check_points: int  # of check faces that were near the path
    deepest_check: Place | None
    gouges_measured_down_to_mm: float
    percentiles_mm: Mapping[str, float]
    histogram: Mapping[str, list[float]]
    sections: Mapping[str, SectionFigures]
    seconds: Mapping[str, float]

    @classmethod
    def of(
        cls,
        cut: Cut,
        sections: Mapping[str, tuple[Section, Floats | None]] | None = None,
        block: Integers | None = None,
    ) -> CutReport:
        """sections: name -> the section, and what a probe finds of it or None; block: as for `Place.of`."""
        values, worst = cut.deviation.deviation_mm, cut.worst()
        counts, edges = np.histogram(values, BINS)
        depth = float(cut.depth_mm(worst.gouge.point[None])[0])
        return cls(
            resolution_mm=cut.resolution_mm,
            stock_box_setup_mm=[cut.stock.lo.tolist(), cut.stock.hi.tolist()],
            volume_left_mm3=None if cut.dexels is None else cut.dexels.volume_mm3,
            points=len(values),
            worst_gouge=Place.of(cut, worst.gouge, block, depth_mm=depth),
            largest_remainder=Place.of(cut, worst.remainder, block),
            check_points=cut.overcut.looked_at,
            deepest_check=worst.check and Place.of(cut, worst.check, block, face=_deepest_face(cut)),
            gouges_measured_down_to_mm=-cut.below_mm,
            percentiles_mm={f"{p:g}": float(np.percentile(values, p)) for p in PERCENTILES},
            histogram={"edges_mm": edges.tolist(), "points": counts.tolist()},
            sections={name: SectionFigures.of(*one) for name, one in (sections or {}).items()},
            seconds=dict(cut.seconds),
        )

    def to_dict(self) -> dict[str, Any]:
        """Plain values for JSON."""
        deepest = self.deepest_check and self.deepest_check.to_dict()
        own = {name: value for name, value in asdict(self).items() if "check" not in name}
        return own | {
            "worst_gouge": self.worst_gouge.to_dict(),
            "largest_remainder": self.largest_remainder.to_dict(),
            "check_faces": {"points": self.check_points, "deepest": deepest},
            "sections": {name: one.to_dict() for name, one in self.sections.items()},
        }

    def to_json(self) -> str:
        """The text of cut.json; ValueError for NaN or an infinity."""
        return json.dumps(self.to_dict(), indent=2, allow_nan=False) + "\n"

    def text(self) -> str:
        """The same for people."""
        below = ", ".join(f"{p} % below {value:.4f}" for p, value in self.percentiles_mm.items())
        left = [] if self.volume_left_mm3 is None else [f"Stock left: {self.volume_left_mm3:.1f} mm3"]
        stages = ", ".join(f"{stage} {seconds:.2f} s" for stage, seconds in self.seconds.items())
        lines = [
            *self.worst_lines(),
            f"Deviation, mm: {below}",
            *left,
            *(one.words(name) for name, one in self.sections.items()),
            f"Time: {stages}",
        ]
        return "\n".join(lines) + "\n"

    def worst_lines(self) -> list[str]:
        """The worst places."""
        return [
            f"Cut into stock, {self.points} points of the faces, every {self.resolution_mm:g} mm",
            f"Worst gouge: {self.worst_gouge.words()}; {self.worst_gouge.depth_mm:.4f} mm inside the tool",
            f"Largest remainder: {self.largest_remainder.words()}",
            self._check_line(),
        ]

    def _check_line(self) -> str:
        if self.deepest_check is not None:
            return f"Check faces: deepest in {self.deepest_check.face}, {self.deepest_check.words()}"
        near = f"none is cut, at {self.check_points} points near the path"
        return f"Check faces: {near if self.check_points else 'none is near'}"


def _deepest_face(cut: Cut) -> str:
    found = cut.overcut
    return str(cut.scene.check[found.face[int(np.argmax(found.depth_mm))]].name)
