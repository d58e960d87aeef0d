"""The job's keys as properties: every key is one or has a stated source, and documents from before still fit."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import replace
from typing import Any

import pytest

from freecad_mpm.core.base import InputError, Key, values
from freecad_mpm.core.job import KEYS
from freecad_mpm.document import messages, properties
from freecad_mpm.document.job_spec import job_of, plain

PLANTED = Key("footprint", "planted_mm", 1.0, values.positive("mm"), "Planted")
# What documents hold: none of these may change.
STORED = {
    "Method": "Enumeration",
    "Spin": "Angle",
    "ContactSpacing": "Length",
    "SpacingMeasure": "Enumeration",
    "TiltMax": "Angle",
    "Direction": "Angle",
    "SideStep": "Length",
    "ForwardStep": "Length",
    "ZigZag": "Bool",
    "Margin": "Distance",
    "AllowGaps": "Bool",
    "SafeClearance": "Length",
    "ApproachDistance": "Length",
    "Recess": "Length",
    "GougeTolerance": "Length",
    "ChordTolerance": "Length",
    "Machine": "Enumeration",
    "Post": "Enumeration",
}
# A value other than the default that each property's check takes, by its type; of choices the last is taken.
OTHER = {"Angle": 12.5, "Length": 0.25, "Distance": -0.25, "Bool": True}


def without_a_source(keys: Iterable[Key]) -> list[str]:
    """Keys that are neither a property nor said to come from elsewhere, or both."""
    own = [one.key for one in properties.settings()]
    return [
        one.full_name for one in keys if own.count(one.full_name) + (one.full_name in messages.ELSEWHERE) != 1
    ]


@pytest.fixture
def fresh(doc: Any) -> Any:
    """An object with the properties and nothing computed."""
    obj = doc.addObject("App::FeaturePython", "Fresh")
    properties.add_missing(obj)
    return obj


def test_every_key_has_one_source() -> None:
    assert without_a_source(KEYS.values()) == []
    assert set(messages.NAMES) == set(KEYS)


def test_a_key_without_a_source_is_found() -> None:
    assert without_a_source([PLANTED]) == ["footprint.planted_mm"]


def test_names_and_types_are_those_that_documents_hold(fresh: Any) -> None:
    assert {one.name for one in properties.settings()} == set(STORED)
    for name, kind in STORED.items():
        assert fresh.getTypeIdOfProperty(name) == f"App::Property{kind}", name


@pytest.mark.parametrize("one", properties.settings(), ids=lambda one: one.name)
def test_words_and_default_are_the_keys(fresh: Any, one: properties.Property) -> None:
    key = KEYS[one.key]
    assert fresh.getDocumentationOfProperty(one.name) == key.words
    assert plain(getattr(fresh, one.name)) == key.default
    assert key.default == key.check(key.default)
    choices = fresh.getEnumerationsOfProperty(one.name) or [key.default]
    assert all(key.check(name) == name for name in choices)


def test_an_unknown_unit_is_refused() -> None:
    with pytest.raises(ValueError, match="FreeCAD has no type here for a positive number of parsecs"):
        properties.type_of(values.positive("parsecs"))


def test_a_stored_value_wins_over_the_default(fresh: Any) -> None:
    fresh.SideStep = 7.5
    properties.add_missing(fresh)
    assert fresh.SideStep.Value == 7.5


@pytest.mark.parametrize("one", properties.settings(), ids=lambda one: one.name)
def test_a_property_reaches_its_key_in_its_unit(op: Any, one: properties.Property) -> None:
    before = job_of(op, (), ())
    choices = op.getEnumerationsOfProperty(one.name)
    value = choices[-1] if choices else OTHER[one.type]
    setattr(op, one.name, value)
    table, name = one.key.split(".")
    assert job_of(op, (), ()) == replace(before, **{table: replace(getattr(before, table), **{name: value})})
    assert job_of(op, (), ()) != before


@pytest.mark.parametrize("one", KEYS.values(), ids=lambda one: one.full_name)
def test_every_key_is_said_in_freecads_words(one: Key) -> None:
    said = messages.in_property_names(f"Op: [{one.table}] {one.name}: must be {one.check.what}, got 0")
    assert said == f"Op: {messages.NAMES[one.full_name]}: must be {one.check.what}, got 0"
    assert not re.search(r"\[\w+\]|[a-z]_[a-z]", said.partition(": must be")[0])


@pytest.mark.parametrize(
    ("told", "said"),
    [
        ("[footprint] side_step_mm, forward_step_mm: give 9", "SideStep, ForwardStep: give 9"),
        (
            "[tool] recess_mm: must be at most minor_radius_mm (2)",
            "Recess: must be at most the tool's CornerRadius",
        ),
        ("[post.options] decimals: must be 3", "the Job's Arguments: decimals: must be 3"),
        (
            "[method] options.window: unknown",
            "the method's own options, which keep their defaults: window: unknown",
        ),
        (
            "[method] minor_radius_mm: exact needs",
            "the tool's CornerRadius (Diameter / 2 less FlatRadius): exact",
        ),
        ("[novel] some_key: is odd", "[novel] some_key: is odd"),
    ],
)
def test_what_else_a_message_may_hold(told: str, said: str) -> None:
    assert messages.in_property_names(told).startswith(said)


def test_a_message_on_the_way_to_a_program_is_translated_too() -> None:
    with pytest.raises(InputError, match="^Op: Margin: is odd$"), messages.property_names():
        raise InputError("Op: [footprint] margin_mm: is odd")
