"""What the comparison comes to: one row a method, and the claims of the published sources beside our figures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .comparison import Row

# The columns that the README shows.
SHORT = (
    "method",
    "worst gouge, mm",
    "two contacts, %",
    "failures",
    "surface points or cells a position",
    "time",
    "guarantee",
)
HEADINGS = (
    "method",
    "worst gouge, mm",
    "99.9 % less deep, mm",
    "two contacts, %",
    "failures",
    "surface points or cells a position",
    "seeds",
    "Newton steps",
    "time",
    "guarantee",
)
CLAIM_HEADINGS = ("claim", "source", "ours")
# The time of the others is given in this one's.
UNIT = "exact"
SHARMA = "Sharma et al. 2021, abstract"
SINGH = "Singh 2020"


@dataclass(frozen=True)
class Table:
    """Rows of texts under headings."""

    headings: Sequence[str]
    rows: Sequence[Sequence[str]]

    def markdown(self) -> str:
        """Lines without an end of line after the last; a "|" in a cell is not escaped."""
        lines = [self.headings, ["---"] * len(self.headings), *self.rows]
        return "\n".join("| " + " | ".join(line) + " |" for line in lines)

    def columns(self, headings: Sequence[str]) -> Table:
        """The table with these columns alone, in this order; ValueError for a heading that it has not."""
        which = [self.headings.index(heading) for heading in headings]
        return Table(headings, [[row[i] for i in which] for row in self.rows])


def blocks(rows: Sequence[Row], searches: Sequence[Row]) -> dict[str, Table]:
    """The generated tables by the names of their blocks in the pages."""
    whole = comparison(rows)
    return {"summary": whole.columns(SHORT), "comparison": whole, "claims": claims(rows, searches)}


def comparison(rows: Sequence[Row]) -> Table:
    """One row a method, its figures on the surfaces in their order; one thread, where there are several counts."""
    single = single_threaded(rows)
    units = {row["surface"]: row["cpu_microseconds_per_position"] for row in single if row["method"] == UNIT}
    methods = list(dict.fromkeys(row["method"] for row in single))
    return Table(
        HEADINGS, [_summary_row([r for r in single if r["method"] == name], units) for name in methods]
    )


def single_threaded(rows: Sequence[Row]) -> list[Row]:
    """The rows with the fewest threads that there are; they are more than one where only such were measured."""
    least = min((row["threads"] for row in rows), default=1)
    return [row for row in rows if row["threads"] == least]


def _summary_row(rows: Sequence[Row], units: dict[str, float]) -> list[str]:
    def each(text: Callable[[Row], str]) -> str:
        return " / ".join(map(text, rows))

    return [
        f"`{rows[0]['method']}`",
        each(lambda row: _depth(row["worst_gouge_mm"])),
        each(lambda row: _depth(row["deep_gouge_mm"])),
        each(lambda row: f"{100 * row['two_contacts']:.1f}"),
        each(lambda row: str(row["failures"])),
        each(lambda row: f"{row['evaluations_per_position'] + row['cells_per_position']:.0f}"),
        each(lambda row: _count(row["seeds_per_position"])),
        each(lambda row: f"{row['newton_steps_per_position']:.0f}"),
        each(lambda row: _time(row, units)),
        str(rows[0]["guarantee"]),
    ]


def _count(value: float) -> str:
    return f"{value:.0f}" if value >= 100 or value == 0 else f"{value:.1f}"


def _depth(value: float | None) -> str:
    return "none" if value is None else f"{value:.4f}"


def _time(row: Row, units: dict[str, float]) -> str:
    unit = units.get(row["surface"])
    mine = row["cpu_microseconds_per_position"]
    return f"{mine / unit:.1f}" if unit else f"{mine:.0f} µs"


def claims(rows: Sequence[Row], searches: Sequence[Row]) -> Table:
    """The published claims that `rows` (of the thesis' surfaces) and `searches` (of `bench_degrees`) can be held to."""
    single = {(row["method"], row["surface"]): row for row in single_threaded(rows)}
    surfaces = list(dict.fromkeys(surface for _, surface in single))
    found = [
        [
            f"{row['surface']}: fewer than 5 seeds and 20 iterations",
            SHARMA,
            f"{row['seeds']:.1f} seeds, {row['newton_steps']:.0f} iterations a position; "
            f"{row['seeds_found']:.1f} and {row['newton_steps_found']:.0f} where two contacts were found; "
            f"{row['newton_steps'] / row['seeds']:.1f} iterations a seed",
        ]
        for row in searches
    ]
    if all((method, surface) in single for method in ("drd", "vcrf") for surface in surfaces) and surfaces:
        drd, vcrf = ([single[method, surface] for surface in surfaces] for method in ("drd", "vcrf"))
        found.append(["`vcrf` an order of magnitude faster than `drd`", SINGH, _ratios(drd, vcrf)])
        found.append(["`drd` slowest on the concave part", SINGH, _work(drd)])
    return Table(CLAIM_HEADINGS, found)


def _ratios(slow: Sequence[Row], fast: Sequence[Row]) -> str:
    times = [
        a["cpu_microseconds_per_position"] / b["cpu_microseconds_per_position"] for a, b in zip(slow, fast)
    ]
    points = [a["evaluations_per_position"] / b["evaluations_per_position"] for a, b in zip(slow, fast)]
    names = " / ".join(row["surface"] for row in slow)
    return f"{_joined(times)} times as long, {_joined(points)} times the surface points ({names})"


def _work(rows: Sequence[Row]) -> str:
    most = rows[int(np.argmax([row["evaluations_per_position"] for row in rows]))]["surface"]
    each = ", ".join(f"{row['surface']} {row['evaluations_per_position']:.0f}" for row in rows)
    return f"most surface points on {most}: {each}"


def _joined(values: Sequence[float]) -> str:
    return " / ".join(f"{value:.1f}" for value in values)
