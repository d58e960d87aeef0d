"""Machine files: what is taken, and what a wrong file is told."""

import math

import pytest

from freecad_mpm.core import machine as machines
from freecad_mpm.core.base import MACHINES, InputError

SHIPPED = (MACHINES / "dmu80p.toml").read_text()


@pytest.mark.parametrize("name", machines.names())
def test_every_shipped_machine_loads_under_its_name(name):
    assert machines.load(name).name == name


def test_dmu80p_is_unconfirmed_45_degree_head_and_endless_table():
    machine = machines.load("dmu80p")
    assert machine.unconfirmed
    assert machine.rotary_letters == ("C", "B")
    assert [axis.role for axis in machine.rotary_axes] == ["table_rotary", "head_rotary"]
    assert machine.rotary_axes[0].max_limit_deg == math.inf
    assert machine.rotary_axes[1].rotation_vector == (0.0, 1.0, 1.0)


def test_a_file_is_loaded_by_its_path(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(SHIPPED.replace('name = "dmu80p"', 'name = "mine"'))
    assert machines.load(path).name == "mine"


@pytest.mark.parametrize(
    "old, new, told",
    [
        ("sense = 1 ", "sense = 2 ", "sense: must be 1 or -1, got 2"),
        ("sense = 1 ", "sens = 1 ", "unknown key; did you mean sense?"),
        ('role = "head_rotary"', 'role = "head"', "role: must be"),
        ("min_limit_deg = 0.0", 'min_limit_deg = "0"', "min_limit_deg: must be a finite number of degrees"),
        ("max_limit_deg = 180.0", "max_limit_deg = -1.0", "rotary axis B: min_limit must be less"),
        ("rotation_vector = [0.0, 1.0, 1.0]", "rotation_vector = [0.0, 0.0, 2.0]", "must not be parallel"),
        (
            "rotation_vector = [0.0, 1.0, 1.0]",
            "rotation_vector = [0.0, 0.0, 0.0]",
            "rotation_vector: must be",
        ),
        ('name = "B"', 'name = "C"', "must have different names"),
        ('name = "Y"', 'name = "X"', "linear_axes: must be X, Y and Z"),
        (
            "max_velocity_mm_per_min = 30000.0",
            "max_velocity_mm_per_min = 0.0",
            "max_velocity_mm_per_min: must be",
        ),
        ("unconfirmed = true", "", "unconfirmed: is missing"),
        ("allow_flip = true", "allow_flips = true", "[kinematics] allow_flips: unknown key"),
        ("[setup]", "[set_up]", "set_up: unknown key"),
        ("[kinematics]", "[kinematics", "is not valid TOML"),
    ],
)
def test_a_wrong_file_is_named_with_the_key(tmp_path, old, new, told):
    assert old in SHIPPED
    path = tmp_path / "wrong.toml"
    path.write_text(SHIPPED.replace(old, new, 1))
    with pytest.raises(InputError) as caught:
        machines.load(path)
    message = str(caught.value)
    assert str(path) in message and told in message and "\n" not in message


def test_a_head_before_a_table_is_refused(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(
        SHIPPED.replace("table_rotary", "T")
        .replace("head_rotary", "table_rotary")
        .replace('"T"', '"head_rotary"')
    )
    with pytest.raises(InputError, match="the table axis comes before the head axis"):
        machines.load(path)


def test_an_unknown_machine_is_told_those_there_are():
    with pytest.raises(InputError, match="machine 'dmu90': unknown; give one of .*dmu80p"):
        machines.load("dmu90")
