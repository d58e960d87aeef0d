"""Errors are one line that names the place."""

from __future__ import annotations

import pytest

from freecad_mpm.core.base import InputError, blame, one_line


def test_blame_puts_the_place_in_front_of_any_value_error_and_drops_line_breaks() -> None:
    with pytest.raises(InputError) as told, blame("job.toml: [footprint]"):
        raise ValueError("side_step_mm:\n must be positive")
    assert str(told.value) == "job.toml: [footprint] side_step_mm: must be positive"


def test_blame_leaves_other_errors_alone() -> None:
    with pytest.raises(KeyError), blame("job.toml"):
        raise KeyError("ours")


def test_one_line() -> None:
    assert one_line(ValueError("a\n  b\tc ")) == "a b c"
