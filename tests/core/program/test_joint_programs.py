"""Programs of joint positions, for controls that do not hold the tip: every post on every machine, and broken ones."""

import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from machine_samples import (
    AXIS_TOLERANCE_DEG,
    TIP_TOLERANCE_MM,
    directions,
    program_of,
    two_passes,
    with_kinematics,
    with_rotary,
)

from freecad_mpm.core import machine as machines
from freecad_mpm.core import posts
from freecad_mpm.core.commands import cli
from freecad_mpm.core.control import Control, check_program, dialects
from freecad_mpm.core.posts import PostOptions

KIND, TIP, AXIS, FEED = two_passes()
MACHINE = "table_bc"
JOINTS = [name for name in posts.names() if posts.load(name).joints]
CONTROL = Control(tcp=False, between_mm=1.05 * TIP_TOLERANCE_MM, between_deg=1.05 * AXIS_TOLERANCE_DEG)
CLOSING_MOVES = 2  # Z up, rotary axes to zero
# Half a unit of the fourth decimal in every word, the angles at a lever of some 200 mm.
WORD_ERROR_MM, WORD_ERROR_DEG = 5e-4, 1e-4


@cache
def program(machine=MACHINE):
    return program_of(KIND, TIP, AXIS, FEED, machines.load(machine), tcp=False)


@cache
def text_of(post, machine=MACHINE):
    return posts.load(post).write(program(machine))


def checked(text, post, machine=MACHINE, tip=TIP, axis=AXIS):
    return check_program(
        dialects.read(text, posts.load(post).dialect), machines.load(machine), tip, axis, CONTROL
    )


def test_which_posts_write_joint_positions():
    assert JOINTS == ["dmu80p", "fanuc", "linuxcnc", "sinumerik", "tnc_klartext"]


@pytest.mark.parametrize("machine", machines.names())
@pytest.mark.parametrize("post", JOINTS)
def test_every_post_passes_on_every_machine(post, machine):
    result = checked(text_of(post, machine), post, machine)
    assert result.findings == []
    assert result.tip_error_mm <= WORD_ERROR_MM and result.axis_error_deg <= WORD_ERROR_DEG
    assert 0.1 * TIP_TOLERANCE_MM < result.tip_between_mm <= CONTROL.between_mm


@pytest.mark.parametrize("post", JOINTS)
def test_the_dialect_is_seen_and_no_word_asks_for_tip_control(post):
    text = text_of(post)
    assert dialects.read(text).grammar == []
    assert not re.search(r"M128|TCPM|TRAORI|G43\.4|M428", text)


@pytest.mark.parametrize("post", JOINTS)
def test_a_program_for_a_control_that_holds_the_tip_is_not_taken_for_joints(post):
    held = posts.load(post).write(program_of(KIND, TIP, AXIS, FEED, machines.load(MACHINE)))
    found = {one.check for one in checked(held, post).findings}
    assert {"state", "round trip"} <= found
    read = dialects.read(text_of(post), posts.load(post).dialect)
    messages = [one.message for one in check_program(read, machines.load(MACHINE), TIP, AXIS).findings]
    assert any("rotary axes in a feed move without M128" in message for message in messages)


def nth_cut(text, n, edit):
    """The text with an edit of its n-th feed move."""
    lines = text.split("\n")
    row = [i for i, line in enumerate(lines) if re.search(r"G0?1 X|L X.* F[\d.]+\r?$", line)][n]
    edited = edit(lines[row])
    assert edited != lines[row]
    return "\n".join([*lines[:row], edited, *lines[row + 1 :]])


def shifted(letter, amount):
    form = rf"{letter}([+-]?[\d.]+)"
    return lambda line: re.sub(form, lambda m: _word(letter, m[1], amount), line, count=1)


def _word(letter, text, amount):
    sign = "+" if text[0] in "+-" else ""
    return f"{letter}{float(text) + amount:{sign}.4f}"


@pytest.mark.parametrize("letter, amount", [("X", 0.01), ("Y", -0.01), ("Z", 0.01), ("B", 0.02), ("C", 0.05)])
@pytest.mark.parametrize("post", JOINTS)
def test_a_joint_that_is_off_is_found(post, letter, amount):
    broken = nth_cut(text_of(post), 40, shifted(letter, amount))
    assert any(one.check == "round trip" for one in checked(broken, post).findings)


@pytest.mark.parametrize("post", JOINTS)
def test_blocks_that_are_missing_are_found_by_the_way_between_the_others(post):
    """Without the blocks put in between, every pose of the CL list is still met: only the way between them tells."""
    given = program()
    last = np.append(np.diff(given.moves.move) != 0, True) | given.moves.is_rapid
    coarse = replace(
        given,
        moves=replace(given.moves, **{name: getattr(given.moves, name)[last] for name in vars(given.moves)}),
        axes_mm=given.axes_mm[last],
    )
    found = checked(posts.load(post).write(coarse), post).findings
    assert "straightness" in {one.check for one in found} and "round trip" not in {one.check for one in found}
    assert any("leaves its way: the tip by" in one.message for one in found)


@pytest.mark.parametrize("post", JOINTS)
def test_limits_are_those_of_the_joints(post):
    broken = nth_cut(text_of(post), 40, shifted("X", 2000.0))
    assert any("X goes to" in one.message for one in checked(broken, post).findings if one.check == "limits")


def test_inverse_time_is_the_tips_time_at_its_feed():
    text = text_of("linuxcnc")
    minutes = sum(1 / float(f) for f in re.findall(r"^G1 .* F([\d.]+)$", text, re.M))
    moves = program().moves
    way = np.linalg.norm(np.diff(moves.tip, axis=0), axis=1)
    at_feed = ~moves.is_rapid[1:]
    planned = (way[at_feed] / moves.feed_mm_per_min[1:][at_feed]).sum()
    assert minutes >= planned
    assert minutes == pytest.approx(planned, rel=0.2)  # the rotary axes need longer here and there


def test_the_feed_of_a_tnc_block_takes_as_long_as_the_tip_may():
    """F is that of all words of a block together, mm and degrees alike."""
    read = dialects.read(text_of("tnc_klartext")).motion()
    moves = program().moves
    rows = slice(len(read.feed) - len(moves) - CLOSING_MOVES, len(read.feed) - CLOSING_MOVES)
    words = np.hstack((read.linear, read.angles["B"][:, None], read.angles["C"][:, None]))[rows]
    cuts = np.flatnonzero(moves.kind == "cut")
    minutes = np.linalg.norm(words[cuts] - words[cuts - 1], axis=1) / read.feed[rows][cuts]
    planned = np.linalg.norm(moves.tip[cuts] - moves.tip[cuts - 1], axis=1) / moves.feed_mm_per_min[cuts]
    turn = np.abs(moves.rotary_deg[cuts] - moves.rotary_deg[cuts - 1]).max(axis=1)
    expected = np.maximum(
        planned, turn / 7200.0
    )  # both rotary axes of the machine turn 7200 degrees a minute
    assert np.abs(minutes / expected - 1.0).max() < 0.01


@pytest.mark.parametrize("post", JOINTS)
def test_where_an_axis_rewinds_the_spindle_goes_up_first(post):
    """A table that has run to its limit turns back at the top, never near the part."""
    machine = with_kinematics(machines.load(MACHINE), allow_flip=False)
    machine = with_rotary(machine, 0, min_limit_deg=-240.0, max_limit_deg=450.0)
    made = program_of(KIND, TIP, AXIS, FEED, machine, tcp=False)
    assert made.moves.troubles() == []
    read = dialects.read(posts.load(post).write(made), posts.load(post).dialect)
    result = check_program(read, machine, TIP, AXIS, CONTROL)
    assert result.findings == []
    steps = np.abs(np.diff(made.moves.rotary_deg[:, 0]))
    rewind = int(np.argmax(steps)) + 1
    assert steps.max() > 90.0
    top = machine.linear_axes[2].max_limit_mm - 1.0
    assert made.moves.linear_mm[rewind - 1 : rewind + 1, 2] == pytest.approx(top)
    assert (made.moves.linear_mm[rewind] == made.moves.linear_mm[rewind - 1]).all()


def test_a_reach_through_the_pole_keeps_the_tip_on_its_line():
    tilt = np.linspace(-6, 6, 25)
    tip = np.column_stack((np.linspace(0, 50, 25), np.zeros(25), np.zeros(25)))
    axis = directions(np.abs(tilt), np.where(tilt < 0, 20.0, 200.0))
    kind = np.array(["rapid"] + ["cut"] * 24)
    machine = with_kinematics(machines.load("table_ac"), pole_cone_deg=0.0004)
    made = program_of(kind, tip, axis, np.full(25, 1000.0), machine, tcp=False)
    text = posts.load("linuxcnc").write(made)
    result = check_program(dialects.read(text), machine, tip, axis, CONTROL)
    assert made.moves.troubles() == [] and result.findings == []


def test_more_decimals_lessen_the_error_of_the_words():
    made = replace(program(), options=PostOptions(decimals=7))
    result = checked(posts.load("linuxcnc").write(made), "linuxcnc")
    assert result.findings == [] and result.tip_error_mm < 5e-7


def test_check_command_is_told_of_joints(tmp_path, capsys):
    path = tmp_path / "p.ngc"
    path.write_text(text_of("linuxcnc"))
    assert cli.main(["check", str(path), "--machine", MACHINE, "--joints"]) == 0
    assert "straightness: passed, tip off its line <= 0.00" in capsys.readouterr().out
    assert cli.main(["check", str(path), "--machine", MACHINE]) == 1
