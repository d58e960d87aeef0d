"""Every check passes a good program and fails one that was broken on purpose."""

import re
from dataclasses import replace

import numpy as np
import pytest
from machine_samples import directions, dmu80p, program_of, two_passes, with_rotary

from freecad_mpm.core.control import Control, check_program
from freecad_mpm.core.control.check import check_continuity, check_grammar, check_limits, check_round_trip
from freecad_mpm.core.control.dialects.din_iso import read
from freecad_mpm.core.control.state import check_state
from freecad_mpm.core.control.walk import Walk, angle_deg
from freecad_mpm.core.posts.dmu80p import write
from freecad_mpm.core.program import report as program_report

KIND, TIP, AXIS, FEED = two_passes()
GOOD = write(program_of(KIND, TIP, AXIS, FEED))
SETUP = Control(part_origin_mm=(0.0, 0.0, 100.0), tool_length_mm=150.0)


def broken(pattern, replacement, text=GOOD, count=1):
    """The text with the first match replaced; the pattern must be there."""
    result, done = re.subn(pattern, replacement, text, count=count, flags=re.M)
    assert done == count
    return read(result)


def nth_cut(n, edit):
    """The good program with an edit of its n-th G01 line."""
    lines = GOOD.split("\r\n")
    row = [i for i, line in enumerate(lines) if " G01 " in line][n]
    edited = edit(lines[row])
    assert edited != lines[row]
    return read("\r\n".join([*lines[:row], edited, *lines[row + 1 :]])), int(
        re.match(r"N(\d+)", lines[row])[1]
    )


def number_of_pose(index):
    """Which G01 line ends in that pose of the CL list."""
    cuts = [block for block in read(GOOD).blocks if block.rapid is False and block.moves]
    return next(n for n, b in enumerate(cuts) if np.abs(np.array(b.position[:3]) - TIP[index]).max() < 1e-3)


def shifted(letter, amount):
    """Edit of a line: a word's value changed by an amount."""
    return lambda line: re.sub(
        rf"{letter}([+-][\d.]+)", lambda m: f"{letter}{float(m[1]) + amount:+.4f}", line, count=1
    )


def test_a_good_program_passes_all_checks():
    result = check_program(read(GOOD), dmu80p(), TIP, AXIS)
    assert result.findings == [] and result.good
    assert result.tip_error_mm <= 1e-4
    assert result.axis_error_deg <= 1e-4


@pytest.mark.parametrize("seed", range(5))
def test_random_paths_pass_all_checks(seed):
    random = np.random.default_rng(seed)
    count = 60
    tip = np.cumsum(random.uniform(-2, 2, (count, 3)), axis=0)
    tilt = np.abs(np.cumsum(random.uniform(-3, 3, count)))  # comes near the pole again and again
    axis = directions(tilt, np.cumsum(random.uniform(-30, 30, count)))
    axis[10] = axis[11] = (0.0, 0.0, 1.0)  # and stands in it
    kind = np.full(count, "cut", dtype="<U8")
    kind[[0, 20, 40]] = "rapid"
    result = check_program(
        read(write(program_of(kind, tip, axis, np.full(count, 800.0)))), dmu80p(), tip, axis
    )
    assert result.findings == []


GRAMMAR = [
    (r"^%MPM01 G71", "%mpm01 G71", "first line must be"),
    (r"N999999 %MPM01", "N999999 %MPM02", "last line must repeat"),
    (r"\r\n", "\n", "carriage return"),
    (r"HEAD", "KÖPF", "must be ASCII"),
    (r" G01 X\+", " G01 X", "is no block"),
    (r"( G01 X[+-]\d+)\.\d+", r"\1.12345", "is no block"),
    (r"( G01) (X\S+) (Y\S+)", r"\1 \3 \2", "is no block"),
    (r"( F1500) \*", r"\1", "is no block"),
    (r" G01 ", " G43 ", "is no block"),
    (r" M126 ", " M6 ", "is no block"),
    (r"( F1500)", r"\1 Q1", "is no block"),
    (r"^N(\d+) M128", "M128", "is no block"),
    (r"^N\d+ M128", "N10 M128", "must be more than the one before"),
    (r"^N\d+ M30", "N999999 M30", "must be less than the end block's"),
    (r"^N\d+ G31 .*\r\n", "", "blank form must be"),
]


@pytest.mark.parametrize("pattern, replacement, told", GRAMMAR)
def test_grammar_breaks_are_found(pattern, replacement, told):
    findings = check_grammar(broken(pattern, replacement))
    assert any(told in finding.message for finding in findings)


def test_an_empty_text_is_no_program():
    assert check_grammar(read(""))[-1].message == "the first line must be %NAME G71 *"


STATE = [
    (r" M3 \*", " *", "spindle off"),
    (r" F300 \*", " *", "before any F"),
    (r"^N\d+ M128 \*\r\n", "", "without M128"),
    (r"G00 G40 G90 (Z-1 M91)", r"G00 G90 \1", "before G40"),
    (
        r"^(N\d+ )G31 G90 (.*)\r\n(.*\r\n.*\r\n)(N\d+) G00 G40 G90",
        r"\1G31 G91 \2\r\n\3\4 G00 G40",
        "not absolute",
    ),
    (
        r"M129 \*\r\n(N\d+ G00 G40 G90 Z-1 M91 \*\r\nN\d+ G00 B\+0 C\+0 M5)",
        r"M9 *\r\n\1",
        "M91 or M92 while M128",
    ),
    (r"^(N\d+) M30", r"\1 M128", "M129 is missing"),
    (r"^N(\d+) G01", r"N\1 T2 G17 S8000 *\r\nN\1 G01", "tool call while M128"),
    (r"(G00 X\S+ Y\S+ Z\S+) \*(?=\r\nN\d+ G01)", r"\1 B+90 C+5 *", "turns and travels at once"),
    (r"^(N\d+) G00 G40 G90 Z-1", r"\1 G40 G90 Z-1", "without G00 or G01"),
]


@pytest.mark.parametrize("pattern, replacement, told", STATE)
def test_state_breaks_are_found(pattern, replacement, told):
    findings = check_state(broken(pattern, replacement))
    assert any(told in finding.message for finding in findings), findings


@pytest.mark.parametrize(
    "letter, amount", [("X", 0.002), ("Z", -0.0015), ("B", 0.004), ("C", -0.01), ("Y", 20.0), ("C", 180.0)]
)
def test_a_wrong_coordinate_is_found_in_its_block(letter, amount):
    program, number = nth_cut(17, shifted(letter, amount))
    trip = check_round_trip(program, dmu80p(), TIP, AXIS)
    assert trip.findings and trip.findings[0].block == number
    assert len(trip.findings) <= 3  # the rest of the program is not blamed


@pytest.mark.parametrize("letter, amount", [("X", 0.0005), ("B", 0.0005)])
def test_an_error_under_the_tolerance_passes_and_is_measured(letter, amount):
    trip = check_round_trip(nth_cut(number_of_pose(9), shifted(letter, amount))[0], dmu80p(), TIP, AXIS)
    assert trip.findings == []
    error = trip.tip_error_mm if letter == "X" else trip.axis_error_deg
    assert error == pytest.approx(amount, rel=0.5)


def test_a_wrong_sense_of_the_table_is_found():
    machine = with_rotary(dmu80p(), 0, sense=-1)
    assert check_round_trip(read(GOOD), machine, TIP, AXIS).findings


def test_a_missing_and_an_extra_block_are_found():
    lines = GOOD.split("\r\n")
    last_of_pass = max(i for i, line in enumerate(lines) if " G01 " in line)
    less = read("\r\n".join(lines[:last_of_pass] + lines[last_of_pass + 1 :]))
    assert check_round_trip(less, dmu80p(), TIP, AXIS).findings
    extra = re.sub(r"Z\S+", "Z+50", lines[last_of_pass])
    more = read("\r\n".join([*lines[: last_of_pass + 1], extra, *lines[last_of_pass + 1 :]]))
    assert check_round_trip(more, dmu80p(), TIP, AXIS).findings


def test_a_program_that_ends_early_is_found():
    cut_off = read(GOOD[: len(GOOD) // 2].rpartition("\r\n")[0] + "\r\nN999999 %MPM01 G71 *\r\n")
    messages = [f.message for f in check_round_trip(cut_off, dmu80p(), TIP, AXIS).findings]
    assert any("is not met" in message for message in messages)


def test_inserted_blocks_must_lie_on_the_way():
    walk = Walk([(0, 0, 0), (10, 0, 0)], directions([0.0, 10.0], 0.0), 0.001, 0.001)
    assert walk.step((0, 0, 0), (0, 0, 1), True) == ""
    assert walk.step((5, 0, 0), directions(5.0, 0.0), False) == ""
    assert "is not pose 1" in walk.step((5, 0, 0), directions(5.5, 0.0), False)
    assert "is not pose 1" in walk.step((5, 0.01, 0), directions(5.0, 0.0), False)
    assert "is not pose 1" in walk.step((5, 0, 0), directions(5.0, 20.0), False)
    assert "is not pose 1" in walk.step((-5, 0, 0), directions(0.0, 0.0), False)
    assert walk.step((0, 0, 0), directions(10.0, 0.0), True) == ""  # a rapid that turns first
    assert walk.step((10, 0, 0), directions(10.0, 0.0), False) == ""
    assert "after the last pose" in walk.step((11, 0, 0), directions(10.0, 0.0), False)
    assert angle_deg((0, 0, 1), directions(1e-5, 0.0)) == pytest.approx(1e-5)


def test_limits_of_every_axis_are_checked():
    assert check_limits(read(GOOD), dmu80p(), SETUP) == []
    findings = check_limits(read(GOOD), with_rotary(dmu80p(), 1, max_limit_deg=25.0), SETUP)
    assert findings and all("B goes to" in finding.message for finding in findings)
    for k, letter in enumerate("XYZ"):
        axes = list(dmu80p().linear_axes)
        middle = 0.5 * (axes[k].min_limit_mm + axes[k].max_limit_mm) - 110.0 * (k == 2)
        axes[k] = replace(axes[k], max_limit_mm=middle)
        findings = check_limits(read(GOOD), replace(dmu80p(), linear_axes=tuple(axes)), SETUP)
        assert findings and all(f"{letter} goes to" in finding.message for finding in findings)


def test_limits_are_checked_along_the_arc_of_a_turn():
    # The part far from the table's axis: both ends of a half turn are in, its middle swings out in Y.
    half_turn = broken(
        r"(M128 \*\r\nN\d+ G00 B\S+ C)\S+ \*", r"\1+175 *", re.sub(r"(M3|M8) \*", r"\1 *", GOOD)
    )
    axes = list(dmu80p().linear_axes)
    axes[1] = replace(axes[1], min_limit_mm=-150.0, max_limit_mm=350.0)
    machine = replace(dmu80p(), linear_axes=tuple(axes))
    number = next(block.number for block in half_turn.blocks if "C+175" in block.text)
    findings = check_limits(half_turn, machine, Control(part_origin_mm=(250.0, 0.0, 100.0)))
    assert number in [finding.block for finding in findings]


def test_jumps_of_the_table_are_found():
    assert check_continuity(read(GOOD), dmu80p()) == []
    program, number = nth_cut(17, shifted("C", 360.0))  # the same position, a turn away
    findings = check_continuity(program, dmu80p())
    assert findings[0].block == number and "more than 180" in findings[0].message
    assert check_round_trip(program, dmu80p(), TIP, AXIS).findings == []  # which only this check sees


def test_large_steps_are_found():
    findings = check_continuity(read(GOOD), dmu80p(), max_rotary_step_deg=1.0)
    assert findings and "more than 1" in findings[0].message


def test_a_change_of_solution_in_a_cut_is_found():
    chain = dmu80p().chain()

    def other_solution(line):
        angles = {letter: float(value) for letter, value in re.findall(r"([BC])(\S+)", line)}
        axis = chain.forward(np.zeros((1, 3)), [[angles["C"], angles["B"]]])[1]
        c, b = next(r for r in chain.inverse(np.zeros((1, 3)), axis)["rotary_deg"][0] if r[1] < 0)
        return re.sub(r"B\S+ C\S+", f"B{b:+.4f} C{c:+.4f}", line)

    program, number = nth_cut(17, other_solution)
    assert check_round_trip(program, dmu80p(), TIP, AXIS).findings == []
    findings = check_continuity(program, dmu80p(), max_rotary_step_deg=179.0)
    assert "other solution" in " ".join(f.message for f in findings if f.block == number)


def test_findings_name_block_and_text():
    program, number = nth_cut(17, shifted("X", 1.0))
    finding = check_round_trip(program, dmu80p(), TIP, AXIS).findings[0]
    assert finding.block == number and str(finding).startswith(f"round trip: N{number} G01 X")


def test_rotary_axes_that_cannot_follow_take_longer():
    tip = np.array([[0.0, 0, 0], [0.001, 0, 0]])
    axis = directions(20.0, [0.0, 90.0])
    program = program_of(np.array(["rapid", "cut"]), tip, axis, np.full(2, 1000.0))
    report = program_report.report(program, 0, check_program(read(write(program)), dmu80p()))
    assert report.time_s["cut"] == pytest.approx(90.0 / 120.0 + 120.0 / 360.0, rel=0.01)  # d / v + v / a


@pytest.mark.parametrize(
    "way, seconds",
    [
        (300.0, 0.3 / 0.5 + 0.1),  # over 50 mm the 500 mm/s are reached: d / v + v / a with a = 5000 mm/s2
        (20.0, 2 * np.sqrt(20.0 / 5000.0)),  # not reached
    ],
)
def test_rapids_start_and_end_at_rest(way, seconds):
    tip = np.array([[0.0, 0, 0], [way, 0, 0]])
    program = program_of(np.array(["rapid", "rapid"]), tip, directions(0.0, [0.0, 0.0]), np.zeros(2))
    report = program_report.report(program, 0, check_program(read(write(program)), dmu80p()))
    assert report.time_s["rapid"] == pytest.approx(seconds, rel=1e-9)
    assert f"rapid {seconds:.1f} s" in report.lines()[0]
