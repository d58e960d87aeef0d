"""Job files: defaults, errors that name the key, and the way back to TOML."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest

from freecad_mpm.core import job
from freecad_mpm.core.base import InputError
from freecad_mpm.core.job import FootprintSpec, Job, MethodSpec, Part, PostSpec, Setup, ToolSpec, tool

MINIMAL = '[part]\nfile = "saddle.step"\n[tool]\nmajor_radius_mm = 6.7\nminor_radius_mm = 6\n'


def load(folder: Path, text: str) -> Job:
    path = folder / "job.toml"
    path.write_text(text)
    return job.load(path)


def test_everything_but_part_and_tool_has_its_default(tmp_path: Path) -> None:
    loaded = load(tmp_path, MINIMAL)
    assert loaded.part == Part(file=str(tmp_path / "saddle.step"), faces=(), check_faces=())
    assert loaded.setup == Setup((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    assert (loaded.tool.recess_mm, loaded.tool.shank, loaded.tool.holder) == (0.0, (), ())
    assert loaded.tool.flute_length_mm > 6.0
    assert loaded.footprint == FootprintSpec("raster", 90.0, 5.0, 2.0, False, 0.0)
    assert (loaded.method.spin_deg, loaded.method.tilt_max_deg) == (0.0, 45.0)
    assert (loaded.tolerance.gouge_mm, loaded.tolerance.chord_mm) == (0.001, 0.01)
    assert (loaded.machine.name, loaded.post.name) == ("dmu80p", "dmu80p")


def test_dump_and_load_give_the_same_job(tmp_path: Path) -> None:
    made = Job(
        part=Part(file='/part ä "quoted".step', faces=("Face1", "Face3"), check_faces=("Face2",)),
        tool=tool.load(tool.find("thesis", tmp_path)),
        setup=Setup(origin=(1.5, -2.0, 1e-7), z=(0.0, 0.6, 0.8), x=(1.0, 0.1, 0.0)),
        footprint=FootprintSpec(direction_deg=12.5, zigzag=True, margin_mm=-1.0),
        method=MethodSpec(name="vcrf", options={"divisions": 16.0}),
        post=PostSpec(program_name="A_1", spindle_rpm=12000),
    )
    assert load(tmp_path, job.dump(made)) == made


def test_a_tool_may_come_from_a_file_beside_the_job(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text("major_radius_mm = 4\nminor_radius_mm = 1\n")
    text = '[part]\nfile = "a.step"\n[tool]\nfile = "{}"\n'
    assert load(tmp_path, text.format("own.toml")).tool.radius_mm == 5.0
    assert load(tmp_path, text.format("thesis")).tool.radius_mm == 12.7
    with pytest.raises(InputError, match="job.toml: .*own.toml: .*recess: unknown key"):
        (tmp_path / "own.toml").write_text("major_radius_mm = 4\nminor_radius_mm = 1\nrecess = 1\n")
        load(tmp_path, text.format("own.toml"))


# What replaces what in a full job file, and how the message goes on after "job.toml: ".
FULL = (
    MINIMAL
    + """
[setup]
origin = [0.0, 0.0, 0.0]
z = [0.0, 0.0, 1.0]
x = [1.0, 0.0, 0.0]
[footprint]
direction_deg = 90.0
side_step_mm = 18.0
zigzag = false
[method]
tilt_max_deg = 45.0
[post]
tool_number = 1
"""
)
WRONG = [
    (
        "major_radius_mm = 6.7",
        "major_radius_mm = -1",
        r"\[tool\] major_radius_mm: must be zero or .*, got -1",
    ),
    ("major_radius_mm = 6.7", "major_radius_mm = nan", r"\[tool\] major_radius_mm: must be .*, got nan"),
    ("major_radius_mm = 6.7", "major_radius_mm = inf", r"\[tool\] major_radius_mm: must be .*, got inf"),
    ("major_radius_mm = 6.7", "major_radius_mm = true", r"\[tool\] major_radius_mm: must be .*, got True"),
    ("major_radius_mm = 6.7", 'major_radius_mm = "6.7"', r"\[tool\] major_radius_mm: must be .*, got '6.7'"),
    ("major_radius_mm = 6.7\n", "", r"\[tool\] major_radius_mm: is missing"),
    ("6.7\nminor_radius_mm = 6", "0\nminor_radius_mm = 0", r"\[tool\] major_radius_mm: must not be 0 when"),
    (
        "radius_mm = 6\n",
        "radius_mm = 6\nrecess_mm = 7\n",
        r"\[tool\] recess_mm: must be at most .*6.*, got 7",
    ),
    (
        "radius_mm = 6\n",
        "radius_mm = 6\nflute_length_mm = 5\n",
        r"\[tool\] flute_length_mm: must be more than",
    ),
    (
        "radius_mm = 6\n",
        'radius_mm = 6\nfile = "thesis"\n',
        r"\[tool\] file: must be the only key, but major",
    ),
    ("radius_mm = 6\n", "radius_mm = 6\nshank = 3\n", r"\[tool\] shank: must be a list of tables, got 3"),
    (
        "radius_mm = 6\n",
        "radius_mm = 6\nshank = [{length_mm = 3}]\n",
        r"\[tool\] shank: .*bottom_radius_mm: is miss",
    ),
    ("z = [0.0, 0.0, 1.0]", "z = [0.0, 0.0, 0.0]", r"\[setup\] z: must be a direction .* not of length zero"),
    ("z = [0.0, 0.0, 1.0]", "z = [0.0, 1.0]", r"\[setup\] z: must be three finite numbers"),
    ("z = [0.0, 0.0, 1.0]", "z = [0.0, nan, 1.0]", r"\[setup\] z: must be three finite numbers"),
    ("x = [1.0, 0.0, 0.0]", "x = [0.0, 0.0, -2.0]", r"\[setup\] x: must not be parallel to z"),
    (
        "side_step_mm = 18.0",
        "side_step_mm = 0.0",
        r"\[footprint\] side_step_mm: must be a positive number of mm, got 0",
    ),
    (
        "side_step_mm = 18.0",
        "side_step = 18.0",
        r"\[footprint\] side_step: unknown key; did you mean side_step_mm\?",
    ),
    ("zigzag = false", "zigzag = 1", r"\[footprint\] zigzag: must be true or false, got 1"),
    ("tilt_max_deg = 45.0", "tilt_max_deg = 90", r"\[method\] tilt_max_deg: must be .* less than 90, got 90"),
    ("tool_number = 1", "tool_number = 1.5", r"\[post\] tool_number: must be a whole number from 1"),
    ("[setup]", "[set_up]", r"\[set_up\]: unknown table; did you mean setup\?"),
    ("[method]", "[[method]]", r"\[method\]: must be a table"),
    ('file = "saddle.step"', "file = 3", r"\[part\] file: must be the name of a file, got 3"),
    ('file = "saddle.step"', 'file = ""', r"\[part\] file: must be the name of a STEP"),
    ('file = "saddle.step"', 'file = "a.step"\nfaces = "Face1"', r"\[part\] faces: must be a list of names"),
    ("[part]", "[part", r"is not valid TOML"),
]


@pytest.mark.parametrize(("right", "wrong", "message"), WRONG)
def test_a_wrong_key_is_named(tmp_path: Path, right: str, wrong: str, message: str) -> None:
    assert right in FULL
    load(tmp_path, FULL)
    with pytest.raises(InputError) as caught:
        load(tmp_path, FULL.replace(right, wrong, 1))
    line = str(caught.value)
    assert "\n" not in line
    assert re.search(rf"job\.toml: {message}", line), line


@pytest.mark.parametrize("name", ["part", "tool"])
def test_a_missing_table_is_named(tmp_path: Path, name: str) -> None:
    with pytest.raises(InputError, match=rf"\[{name}\]: is missing"):
        load(tmp_path, MINIMAL.replace(f"[{name}]", "[setup]" if name == "part" else "[footprint]"))


def test_a_script_gets_the_same_checks() -> None:
    with pytest.raises(InputError, match=r"^\[tool\] minor_radius_mm: must be"):
        ToolSpec(major_radius_mm=6.7, minor_radius_mm=-6.0)
    with pytest.raises(InputError, match=r"^\[footprint\] pattern: must be \"raster\", got 'spiral'"):
        replace(FootprintSpec(), pattern="spiral")
