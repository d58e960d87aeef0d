"""What the values of a job may be."""

from __future__ import annotations

import math
from typing import Any

import pytest

from freecad_mpm.core.base import values

GOOD = [
    (values.positive("mm"), 3, 3.0),
    (values.not_negative("mm"), 0, 0.0),
    (values.number("mm"), -1.5, -1.5),
    (values.between(-180, 180, "degrees"), 180, 180.0),
    (values.inside(0, 90, "degrees"), 89.9, 89.9),
    (values.whole(1, 9), 9, 9),
    (values.choice("a", "b"), "b", "b"),
    (values.texts, ["x"], ("x",)),
    (values.vector, [1, 2, 3], (1.0, 2.0, 3.0)),
]
WRONG: list[tuple[Any, Any, str]] = [
    (values.positive("mm"), 0, "must be a positive number of mm, got 0"),
    (values.positive("mm"), True, "must be a positive number of mm, got True"),
    (values.number("mm"), math.nan, "must be a finite number of mm, got nan"),
    (values.between(-180, 180, "degrees"), 181, "must be a number of degrees from -180 to 180, got 181"),
    (values.inside(0, 90, "degrees"), 90, "must be a number of degrees more than 0 and less than 90, got 90"),
    (values.whole(1, 9), 1.0, "must be a whole number from 1 to 9, got 1.0"),
    (values.choice("a", "b"), "c", 'must be "a" or "b", got'),
    (values.texts, "x", "must be a list of names"),
    (values.vector, [1, 2], "must be three finite numbers"),
    (values.direction, [0, 0, 0], "must be a direction that is not of length zero"),
]


@pytest.mark.parametrize(("check", "given", "taken"), GOOD)
def test_a_right_value_comes_back_in_its_own_type(check: Any, given: Any, taken: Any) -> None:
    found = check(given)
    assert found == taken and type(found) is type(taken)


@pytest.mark.parametrize(("check", "given", "told"), WRONG)
def test_a_wrong_value_is_told_what_would_be_right(check: Any, given: Any, told: str) -> None:
    with pytest.raises(ValueError) as error:
        check(given)
    assert str(error.value).startswith(told)


def test_parallel_directions() -> None:
    assert values.are_parallel((0.0, 0.0, 2.0), (0.0, 0.0, -1.0))
    assert not values.are_parallel((0.0, 0.0, 1.0), (0.0, 1e-6, 1.0))
