"""What the posts for the dialects of ISO 6983 share: G0 and G1, numbers that always have their point."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from ..base import Floats
from .options import COMMON
from .program import Program
from .writing import VECTOR_DECIMALS, Style, move_lines, rotary_names, with_stops, words

OPTIONS = COMMON
INVERSE_TIME = "G93"
PER_MINUTE = "G94"


def moves(
    program: Program, comment: str, vector: tuple[str, str, str] | None = None, inverse_time: bool = False
) -> list[str]:
    """One block a move; `vector`: names of the components of the tool's direction. Without TCP the feed is always
    inverse time, as the tip's way is not the axes'."""
    return with_stops(program, move_lines(program, _style(program, vector, inverse_time)), "M0", comment)


def _style(program: Program, vector: tuple[str, str, str] | None, inverse_time: bool) -> Style:
    length = f"%.{program.options.decimals}f"
    return Style(
        rapid="G0",
        feed="G1",
        length=length,
        turn_names=vector or rotary_names(program),
        turn=f"%.{VECTOR_DECIMALS}f" if vector else length,
        rate=" F%.6f" if inverse_time or not program.tcp else " F%.3f",
        vectors=vector is not None,
        inverse_time=inverse_time or not program.tcp,
    )


def axis_words(program: Program, names: Iterable[str], values: Floats | Sequence[float]) -> str:
    """Rounded to the post's decimals, mm or degrees, each with its point."""
    return words(names, values, f"%.{program.options.decimals}f", program.options.decimals)


def vector_words(program: Program, names: tuple[str, str, str]) -> str:
    """The tool's direction in the first move."""
    return words(names, program.moves.axis[0], f"%.{VECTOR_DECIMALS}f", VECTOR_DECIMALS)


def rotary_zero(program: Program) -> str:
    """Words that turn both rotary axes to 0 degrees."""
    return axis_words(program, rotary_names(program), (0.0, 0.0))
