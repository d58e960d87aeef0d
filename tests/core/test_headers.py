"""What a header of the native core says of its own failures: a caller who reads it alone knows what is thrown."""

import re
from pathlib import Path

import pytest

CORE = Path(__file__).resolve().parents[2] / "native/src/mpm"
HEADERS = sorted(CORE.rglob("*.h"))
# require() of base/error.h is how the core refuses an argument.
THROWS = re.compile(r"\bthrow std::invalid_argument\b|\brequire\(")
SAYS_SO = re.compile(r"\b(?:Fails|Throws|throws)\b")
CODE_COMMENT = re.compile(r"//.*")


def comments(text: str) -> str:
    return "\n".join(CODE_COMMENT.findall(text))


def refuses(header: Path) -> bool:
    """Whether the source of this header's name throws std::invalid_argument itself."""
    source = header.with_suffix(".cpp")
    return source.exists() and THROWS.search(CODE_COMMENT.sub("", source.read_text())) is not None


def is_silent(header: Path) -> bool:
    """Whether a header keeps to itself what its source throws."""
    return refuses(header) and SAYS_SO.search(comments(header.read_text())) is None


@pytest.mark.parametrize("header", HEADERS, ids=lambda header: str(header.relative_to(CORE)))
def test_a_header_says_what_its_source_throws(header: Path) -> None:
    assert not is_silent(header), f"{header}: say with 'Fails:' when std::invalid_argument is thrown"


def test_there_are_headers_that_have_to_say_so() -> None:
    assert {"registry.h", "tool.h", "raster.h"} <= {header.name for header in HEADERS if refuses(header)}


@pytest.mark.parametrize(
    ("header", "source", "silent"),
    [
        ("// Halves x.\nint f(int x);", 'require(x > 0, "x must be positive");', True),
        ("// Halves x.\nint f(int x);", 'throw std::invalid_argument("x");', True),
        ("int Fails(int x);", 'require(x > 0, "x must be positive");', True),
        ("// Fails: std::invalid_argument for x <= 0.\nint f(int x);", 'require(x > 0, "x");', False),
        ("// Throws std::invalid_argument.\nint f(int x);", 'throw std::invalid_argument("x");', False),
        ("// Halves x.\nint f(int x);", "return x / 2;  // no require(x > 0) here", False),
        ("// Halves x.\nint f(int x);", None, False),
    ],
)
def test_a_silent_header_is_found(tmp_path: Path, header: str, source: str | None, silent: bool) -> None:
    planted = tmp_path / "planted.h"
    planted.write_text(header)
    if source is not None:
        planted.with_suffix(".cpp").write_text(source)
    assert is_silent(planted) == silent
