"""The thesis' tables 2 and 3 (M. Singh, Waterloo 2020, chapter 5): its deviations beside those of our paths.

Its surfaces, tool and footprint; the section at Y = 27 mm. Where its print can be read in two ways both are computed:

- DRD with the outer quarter of the ring only, as printed, and with the inner one too (`inner half`);
- nothing beyond the patch, or the polynomial going on past its border (`continued`);
- the saddle's control points as printed, row i along x, and with their indices exchanged (`exchanged`)."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from .. import job, planning, removal
from ..base import EXAMPLES, Flags, Floats, Progress, Stages
from ..job import Job
from ..part import FaceArrays, Scene, prepare
from ..pictures import png_bytes
from ..removal import Section

SURFACES = ("convex", "concave", "saddle")
EXCHANGED = "saddle, exchanged"
SECTION_Y_MM = 27.0
# Least and largest simulated deviation, mm: tables 2 (DRD) and 3 (VCRF).
THESIS = {
    ("drd", "convex"): (2.9e-5, 0.54),
    ("drd", "concave"): (1.4e-3, 0.92),
    ("drd", "saddle"): (2.4e-5, 0.79),
    ("vcrf", "convex"): (1.1e-6, 0.53),
    ("vcrf", "concave"): (1.3e-6, 0.60),
    ("vcrf", "saddle"): (9.0e-7, 0.62),
}
# By how much of its parameters a patch goes on past each border when it is continued.
CONTINUATION = 0.15
# A tilt limit so small that the tool stays upright: three axes.
UPRIGHT_DEG = 1e-6
# Distance of the deviation's points from which the section starts.
RESOLUTION_MM = 1.0
SPACING_MM = 0.01


@dataclass(frozen=True)
class Case:
    """One way to machine a surface: a method with options, the tool, and what lies beyond the patch."""

    label: str
    method: str
    options: tuple[tuple[str, float], ...] = ()
    continued: bool = False
    upright: bool = False
    ball: bool = False


CASES = (
    Case("DRD", "drd"),
    Case("DRD, inner half", "drd", (("inner_half", 1.0),)),
    Case("DRD, continued", "drd", continued=True),
    Case("VCRF", "vcrf"),
    Case("VCRF, continued", "vcrf", continued=True),
    Case("exact", "exact"),
    Case("three axes, same cutter", "exact", upright=True),
    Case("three axes, ball", "exact", upright=True, ball=True),
)


@dataclass(frozen=True, eq=False)
class Measured:
    """A case on a surface: the section, and its deviation along the set-up's z beside that along the normal."""

    surface: str
    case: Case
    section: Section
    vertical_mm: Floats
    interior: Flags  # (N,) flags: between the passes on which the whole cutter stands over the face

    @property
    def row(self) -> dict[str, Any]:
        """Its numbers for published.json, mm: pairs are (least, most); `thesis_mm` is None where the thesis has
        none."""
        inside, along = self.interior, self.section.deviation_mm
        base = "saddle" if self.surface == EXCHANGED else self.surface
        thesis = THESIS.get((self.case.method, base))
        return {
            "surface": self.surface,
            "case": self.case.label,
            "thesis_mm": thesis,
            "interior_mm": (float(along[inside].min()), float(along[inside].max())),
            "all_mm": (float(along.min()), float(along.max())),
            "edge_max_mm": float(along[~inside].max()),
            "interior_vertical_max_mm": float(self.vertical_mm[inside].max()),
            "points": len(along),
        }


def measure_all(
    surfaces: Sequence[str] = (*SURFACES, EXCHANGED),
    cases: Sequence[Case] = CASES,
    on_progress: Progress | None = None,
    threads: int = 0,
) -> Iterator[Measured]:
    """Every case on every surface."""
    for surface in surfaces:
        for case in cases:
            yield measure(surface, case, on_progress, threads)


def measure(surface: str, case: Case, on_progress: Progress | None = None, threads: int = 0) -> Measured:
    """Plan the case on the thesis' footprint and cut the section at Y = 27 mm."""
    spec = job.load(EXAMPLES / f"{surface.split(',')[0]}.toml")
    stages = Stages(on_progress, threads=threads)
    faces = list(prepare(spec, None, stages).machined)
    if surface == EXCHANGED:
        faces = [_exchanged(face) for face in faces]
    spec = _with_case(spec, case)
    planned = [_continued(face) for face in faces] if case.continued else faces
    plan = planning.plan(spec, planned, on_progress=on_progress, threads=threads)
    scene = prepare(spec, faces, stages)
    cut = removal.cut(
        scene, plan.path, RESOLUTION_MM, with_stock=False, on_progress=on_progress, threads=threads
    )
    section = cut.section((0.0, SECTION_Y_MM, 0.0), (0.0, 1.0, 0.0), SPACING_MM)
    up = np.tile(scene.frame.axes[:, 2], (len(section.points), 1))
    vertical, _ = cut.heights(section.points, up)
    return Measured(surface, case, section, vertical, _interior(spec, scene, section))


def _with_case(spec: Job, case: Case) -> Job:
    method = replace(spec.method, name=case.method, options=dict(case.options))
    if case.upright:
        method = replace(method, tilt_max_deg=UPRIGHT_DEG)
    tool = spec.tool
    if case.ball:
        radius = tool.radius_mm
        tool = replace(tool, major_radius_mm=0.0, minor_radius_mm=radius, recess_mm=0.0)
    footprint = spec.footprint
    if case.continued:
        footprint = replace(footprint, margin_mm=-CONTINUATION * 150.0)
    return replace(spec, method=method, tool=tool, footprint=footprint)


def _exchanged(face: FaceArrays) -> FaceArrays:
    poles = face.poles.copy()
    poles[:, :, 2] = poles[:, :, 2].T
    return replace(face, poles=poles)


def _continued(face: FaceArrays) -> FaceArrays:
    """The same bicubic polynomial over parameters from -CONTINUATION to 1 + CONTINUATION."""
    change = np.array([_bernstein(-CONTINUATION + (1 + 2 * CONTINUATION) * t) for t in np.arange(4) / 3.0])
    to_poles = np.linalg.inv(np.array([_bernstein(t) for t in np.arange(4) / 3.0])) @ change
    return replace(face, poles=np.einsum("ai,bj,ijk->abk", to_poles, to_poles, face.poles))


def _bernstein(t: float) -> list[float]:
    return [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3]


def _interior(spec: Job, scene: Scene, section: Section) -> Flags:
    """Between the first and the last pass whose distance from the border is at least the cutter's radius."""
    low, high = (float(corner[0]) for corner in scene.model.machined_bounds())
    passes = np.arange(low, high, spec.footprint.side_step_mm)
    radius = scene.tool.radius
    inside = passes[(passes >= low + radius) & (passes <= high - radius)]
    return np.asarray((section.s_mm >= inside[0]) & (section.s_mm <= inside[-1]))


HEADS = ("surface", "case", "thesis", "interior passes", "all passes", "vertical, interior")


def table(rows: Sequence[dict[str, Any]]) -> str:
    """The rows for people: least and largest deviation from the modelled section, mm."""
    cells = [HEADS, *(_cells(row) for row in rows)]
    widths = [max(map(len, column)) for column in zip(*cells)]
    return "\n".join(
        "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in cells
    )


def _cells(row: dict[str, Any]) -> tuple[str, ...]:
    thesis = "" if row["thesis_mm"] is None else f"{row['thesis_mm'][0]:.1e} .. {row['thesis_mm'][1]:.2f}"
    interior, all_passes = (f"{low:+.4f} .. {high:.3f}" for low, high in (row["interior_mm"], row["all_mm"]))
    return (
        row["surface"],
        row["case"],
        thesis,
        interior,
        all_passes,
        f"{row['interior_vertical_max_mm']:.3f}",
    )


def to_json(rows: Sequence[dict[str, Any]]) -> str:
    """The text of published.json; the section's y, mm, stands beside the rows."""
    return json.dumps({"section_y_mm": SECTION_Y_MM, "rows": list(rows)}, indent=2, allow_nan=False) + "\n"


# The cases of a picture, as the thesis' figures 5.3 (DRD) and 5.5 (VCRF), and ours.
PICTURED = ("DRD", "VCRF", "exact")


def files(measured: Sequence[Measured]) -> dict[str, bytes | str]:
    """The rows as JSON and text, and a picture a surface."""
    rows = [one.row for one in measured]
    result: dict[str, bytes | str] = {"published.json": to_json(rows), "published.txt": table(rows) + "\n"}
    for surface in dict.fromkeys(one.surface for one in measured):
        shown = [one for one in measured if one.surface == surface and one.case.label in PICTURED]
        if shown:
            name = surface.replace(", ", "_")
            result[f"published_{name}.png"] = picture(shown, f"{surface}: section at Y = {SECTION_Y_MM:g} mm")
    return result


def picture(measured: Sequence[Measured], title: str) -> bytes:
    """The modelled and the machined section, as the thesis' figures 5.3 and 5.5 show them, and below their distance."""
    figure = Figure(figsize=(16, 10), dpi=100, facecolor="white")
    FigureCanvasAgg(figure)
    figure.text(0.02, 0.965, title, fontsize=14, weight="bold", va="center")
    above, below = figure.add_axes((0.07, 0.56, 0.9, 0.36)), figure.add_axes((0.07, 0.08, 0.9, 0.38))
    first = measured[0].section
    above.plot(first.s_mm, first.points[:, 2], color="#777777", linewidth=1.2, label="modelled")
    for one, colour in zip(measured, ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00")):
        along = one.section.machined
        above.plot(along[:, 0], along[:, 2], color=colour, linewidth=0.9, label=one.case.label)
        below.plot(
            one.section.s_mm, one.section.deviation_mm, color=colour, linewidth=0.9, label=one.case.label
        )
    below.axhline(0.0, color="#777777", linewidth=0.8)
    for axes, height in ((above, "Z / mm"), (below, "machined above modelled / mm")):
        axes.set_xlabel("X / mm")
        axes.set_ylabel(height)
        axes.legend(frameon=False, fontsize=9)
    return png_bytes(figure)
