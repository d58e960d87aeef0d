"""The DIN/ISO writer: the text itself, letter for letter where it matters."""

import re
from dataclasses import replace

import numpy as np
import pytest
from machine_samples import dmu80p, program_of, two_passes
from speed import formatting_s, worked_s

from freecad_mpm.core import posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.machine import Moves
from freecad_mpm.core.posts import PostOptions, Program, ProgramTool, program_name
from freecad_mpm.core.posts.dmu80p import write

# A short program of the 45 degree head, tilts of 12 to 14 degrees, with its joint values given.
ANGLES = [(173.9668, 17.0019)] * 2 + [
    (171.0616, 17.8554),
    (167.9048, 18.8518),
    (164.796, 19.9914),
    (164.796, 19.9914),
]
TIPS = [
    (-10.3956, 27, 67.3386),
    (0, 27, 18.4312),
    (2.5, 27, 18.7004),
    (5, 27, 18.9017),
    (7.5, 27, 19.0361),
    (-4.5592, 28.7163, 67.5297),
]
TEXT = """\
%MPM01 G71 *
N10 G30 G17 X-5 Y-5 Z-25 *
N20 G31 G90 X+85 Y+59 Z+25 *
N30 ; DMU80P B45 HEAD C TABLE - UNCONFIRMED - T1 TOROID R10 R2 3 *
N40 M129 *
N50 G00 G40 G90 Z-1 M91 *
N60 T1 G17 S8000 *
N70 G00 B+0 C+0 M126 *
N80 G00 X-10.3956 Y+27 M3 *
N90 G00 Z+167.3386 M8 *
N100 M128 *
N110 G00 B+17.0019 C+173.9668 *
N120 G00 X-10.3956 Y+27 Z+67.3386 *
N130 G01 X+0 Y+27 Z+18.4312 F1500 *
N140 G01 X+2.5 Y+27 Z+18.7004 B+17.8554 C+171.0616 F2000 *
N150 G01 X+5 Y+27 Z+18.9017 B+18.8518 C+167.9048 *
N160 G01 X+7.5 Y+27 Z+19.0361 B+19.9914 C+164.796 *
N170 G00 X-4.5592 Y+28.7163 Z+67.5297 *
N180 M129 *
N190 G00 G40 G90 Z-1 M91 *
N200 G00 B+0 C+0 M5 *
N210 M30 *
N999999 %MPM01 G71 *
"""


def example(**changes):
    moves = Moves(
        kind=np.array(["rapid", "plunge", "cut", "cut", "cut", "rapid"]),
        tip=np.array(TIPS, float),
        axis=np.tile((0.0, 0.0, 1.0), (6, 1)),
        rotary_deg=np.array(ANGLES),
        feed_mm_per_min=np.array([0, 1500, 2000, 2000, 2000, 0.0]),
    )
    blank = (np.array([-5.0, -5.0, -25.0]), np.array([85.0, 59.0, 25.0]))
    return replace(Program("MPM01", dmu80p(), ProgramTool(1, 10.0, 3.0), 8000, moves, blank=blank), **changes)


def moves_of(count, **columns):
    """`count` cuts straight along x, after a rapid to the start."""
    rows = dict(
        kind=np.array(["rapid"] + ["cut"] * (count - 1)),
        tip=np.column_stack((np.linspace(0, 1, count), np.zeros(count), np.zeros(count))),
        axis=np.tile((0.0, 0.0, 1.0), (count, 1)),
        rotary_deg=np.zeros((count, 2)),
        feed_mm_per_min=np.full(count, 1000.0),
    )
    return Moves(**(rows | columns))


def test_whole_text():
    assert write(example()) == TEXT.replace("\n", "\r\n")


def test_registry_knows_name_ending_and_writer():
    assert "dmu80p" in posts.names() and "program" not in posts.names()
    post = posts.load("dmu80p")
    assert (post.name, post.file_ending) == ("dmu80p", ".I")
    assert post.write(example()) == write(example())
    with pytest.raises(InputError, match="post 'x': unknown; give one of .*dmu80p"):
        posts.load("x")


def test_numbers_have_a_sign_at_most_four_decimals_and_no_minus_zero():
    tip = np.array([[0, -0.0, 1], [-1e-6, 0.00005001, 99999.9999], [1e-4, 1 / 3, -2 / 3]])
    text = write(example(moves=moves_of(3, tip=tip)))
    assert "X+0 Y+0.0001 Z+99999.9999 " in text
    assert "X+0.0001 Y+0.3333 Z-0.6667 *" in text
    assert "-0 " not in text and "e-" not in text


def test_angles_and_feed_are_written_when_they_change():
    text = write(program_of(*two_passes()))
    cuts = [line for line in text.split("\r\n") if " G01 " in line]
    assert [f for line in cuts for f in re.findall(r"F(\S+)", line)] == [
        "300",
        "1500",
        "500",
        "300",
        "1500",
        "500",
    ]
    assert sum(" B" in line for line in cuts) < len(cuts)


def test_rapids_never_turn_and_travel():
    rapids = re.findall(r"^N\d+ G00 (.*) \*", write(program_of(*two_passes())), re.M)
    turning = [line for line in rapids if re.search("[BC]", line)]
    assert len(turning) >= 4
    assert not any(re.search("[XYZ]", line) for line in turning)


@pytest.mark.parametrize("moves, step", [(99_000, 10), (100_000, 1)])
def test_block_numbers_stay_below_the_end_block(moves, step):
    text = write(example(moves=moves_of(moves)))
    numbers = [int(n) for n in re.findall(r"^N(\d+)", text, re.M)]
    assert (np.diff(numbers[:-1]) == step).all()
    assert numbers[-1] == 999_999 and numbers[-2] < 999_999


def test_a_program_that_is_too_long_is_refused():
    with pytest.raises(InputError, match="do not fit below the end block N999999"):
        write(example(moves=moves_of(999_990)))
    longer = example(moves=moves_of(999_990), options=PostOptions(end_block=99_999_999))
    assert write(longer).endswith("N99999999 %MPM01 G71 *\r\n")


def test_hundred_thousand_moves_take_about_as_long_as_making_text_of_their_numbers():
    angles = np.column_stack((np.linspace(0, 3000, 100_000), np.linspace(0, 90, 100_000)))
    program = example(moves=moves_of(100_000, rotary_deg=angles))
    assert worked_s(lambda: write(program)) < 4 * formatting_s(500_000)


def test_coolant_and_blank_are_left_out_on_request():
    text = write(example(options=PostOptions(coolant="off"), blank=None))
    assert "M8" not in text and "G30" not in text and "N30 G00 G40 G90 Z-1 M91 *" in text


@pytest.mark.parametrize("thin", [0.0, 0.2])
def test_a_blank_that_the_control_cannot_draw_is_left_out(thin):
    assert "G30" not in write(example(blank=(np.zeros(3), np.array([100.0, 50.0, thin]))))


@pytest.mark.parametrize("radii, word", [((10, 0), "END MILL"), ((10, 10), "BALL"), ((10, 3), "TOROID")])
def test_comment_tells_the_kind_of_tool(radii, word):
    assert word in write(example(tool=ProgramTool(7, *radii)))


def test_comment_holds_nothing_that_ends_it():
    text = write(example(machine=replace(dmu80p(), description="é*%;x", unconfirmed=False)))
    line = next(line for line in text.split("\r\n") if ";" in line)
    assert line.isascii() and line.count(";") == 1 and line.count("*") == 1 and "%" not in line
    assert "UNCONFIRMED" not in line


def test_values_beyond_the_control_are_refused():
    tip = np.zeros((3, 3))
    tip[2, 1] = 1e5
    with pytest.raises(InputError, match=r"tip\[2\]: must be within"):
        write(example(moves=moves_of(3, tip=tip)))


@pytest.mark.parametrize(
    "change, told",
    [
        (dict(name="saddle 1"), "program name 'saddle 1': .*SADDLE_1 would be right"),
        (dict(name="A" * 17), "1 to 16 capital letters"),
        (dict(spindle_rpm=0.0), "spindle_rpm: must be positive"),
        (dict(tool=ProgramTool(0, 10, 3)), "tool number"),
        (dict(moves=moves_of(3, kind=np.array(["cut"] * 3))), "the first must be a rapid"),
    ],
)
def test_a_wrong_program_is_refused(change, told):
    with pytest.raises(InputError, match=told):
        example(**change)


@pytest.mark.parametrize(
    "columns, told",
    [
        (dict(tip=np.zeros((2, 3))), r"tip: must have shape \(3, 3\)"),
        (dict(rotary_deg=np.array([[0, 0], [0, np.nan], [0, 0]])), r"rotary_deg\[1\]: must be finite"),
        (dict(kind=np.array(["rapid", "dig", "cut"])), "kind: must be of .*got dig"),
        (dict(feed_mm_per_min=np.array([0.0, 0.0, 1.0])), r"feed_mm_per_min\[1\]: must be positive"),
    ],
)
def test_wrong_moves_are_refused(columns, told):
    with pytest.raises(InputError, match=told):
        moves_of(3, **columns)


def test_program_names_are_made_from_any_text():
    assert program_name("Saddle part.step") == "SADDLE_PART_STEP"
    assert program_name("é") == "MPM"
