"""Every post on every machine is read back by a reader of its own, and a text broken on purpose is found."""

import re
from functools import cache

import numpy as np
import pytest
from machine_samples import program_of, two_passes

from freecad_mpm.core import machine as machines
from freecad_mpm.core import posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.commands import cli
from freecad_mpm.core.control import check_program, dialects

KIND, TIP, AXIS, FEED = two_passes()
MACHINE = "table_bc"
# Half a unit of the fourth decimal in three coordinates; the tool's direction from two rounded angles.
WORD_ERROR_MM, WORD_ERROR_DEG = 0.5e-4 * np.sqrt(3), 1e-4
ANGLES = ["fanuc", "linuxcnc", "sinumerik", "tnc_klartext", "tnc_klartext_tcpm"]
VECTORS = ["fanuc_vectors", "sinumerik_vectors", "tnc_vectors"]


@cache
def text_of(post, machine=MACHINE):
    return posts.load(post).write(program_of(KIND, TIP, AXIS, FEED, machines.load(machine)))


def checked(text, post, machine=MACHINE):
    parsed = dialects.read(text, posts.load(post).dialect)
    return check_program(parsed, machines.load(machine), TIP, AXIS)


@pytest.mark.parametrize("machine", machines.names())
@pytest.mark.parametrize("post", posts.names())
def test_every_post_passes_on_every_machine(post, machine):
    result = checked(text_of(post, machine), post, machine)
    assert result.findings == []
    assert result.tip_error_mm <= WORD_ERROR_MM and result.axis_error_deg <= WORD_ERROR_DEG


@pytest.mark.parametrize("post", posts.names())
def test_the_dialect_is_seen_in_the_text(post):
    seen = dialects.read(text_of(post))
    assert (seen.name, seen.grammar) == ("MPM01", [])


def test_another_text_is_told_what_can_be_read():
    with pytest.raises(InputError, match="must be one of din_iso, klartext"):
        dialects.read("G1 X0\n")


SHARED = ["fanuc", "fanuc_vectors", "linuxcnc", "sinumerik", "sinumerik_vectors"]
KLARTEXT = ["tnc_klartext", "tnc_klartext_tcpm", "tnc_vectors"]

# posts, pattern, replacement, the check that must find it and what it says
BREAKS = [
    (SHARED, r"G1 X", "G3 X", "grammar", "G3 is not a word"),
    (SHARED, r"Y(\S+)", r"Y\1 Y\1", "grammar", "has the word Y twice"),
    (SHARED, r"M30\s*$", "M8\n", "grammar", "M30"),
    (SHARED + KLARTEXT, r"G1 X|LN? X", "Q X", "grammar", ""),
    (["fanuc", "fanuc_vectors"], r"G1 X(-?\d+)\.\d*", r"G1 X\1", "grammar", "its number is not one"),
    (["linuxcnc"], r"(G1 .*) F.*", r"\1", "grammar", "without F under inverse time"),
    (["sinumerik"], r"^N200 ", "N20 ", "grammar", "must follow the one before"),
    (KLARTEXT, r"^20 ", "21 ", "grammar", "must follow the one before, 19"),
    (KLARTEXT, r"^(20 .*) Z(\S+)", r"\1 Z\g<2>00001", "grammar", "is no block of the control"),
    (KLARTEXT, r"END PGM MPM01", "END PGM MPM02", "grammar", "the last line must be"),
    (["apt"], r"GOTO/([^,]*),", r"GOTO/\1 ", "grammar", "is no statement"),
    (["apt"], r"FINI", "END", "grammar", "must be FINI"),
    (["sinumerik_vectors"], r"C3=0", "C3=1", "grammar", "must be a unit vector"),
    (SHARED, r"(S8000) M3", r"\1 M5", "state", "spindle off"),
    (KLARTEXT, r" M3\b", "", "state", "spindle off"),
    (["apt"], r"SPINDL/RPM.*", "SPINDL/OFF", "state", "spindle off"),
    (["fanuc", "sinumerik", "linuxcnc"], r"G40 ", "", "state", "before G40"),
    (["sinumerik"], r"TRAORI", "TRAFOOF", "state", "without M128"),
    (["linuxcnc"], r"M428", "M429", "state", "without M128"),
    (["tnc_klartext"], r"M128", "M129", "state", "without M128"),
    (["tnc_klartext_tcpm"], r"FUNCTION TCPM.*PATHCTRL AXIS", "M129", "state", "without M128"),
    (["fanuc"], r"G43\.4 H1 ", "G0 ", "state", "without M128"),
    (["fanuc", "sinumerik"], r" F[\d.]+", "", "state", "before any F"),
    (["linuxcnc", "sinumerik"], r"G90", "G91", "grammar", "G91 is not a word"),
    (["fanuc"], r"G90 G54", "G91 G54", "state", "not absolute"),
    (["linuxcnc"], r"^M429\n(G53.*)\n(G0 .*\nM9)", r"\1\n\2", "state", "while M128 is on"),
    (KLARTEXT, r"^(\d+) (?:M129|FUNCTION RESET TCPM)\s+\d+ L Z-1", r"\1 L Z-1", "state", "while M128 is on"),
]


@pytest.mark.parametrize(
    "post, pattern, replacement, check, told",
    [(post, *rest) for broken, *rest in BREAKS for post in broken],
)
def test_a_broken_text_is_found(post, pattern, replacement, check, told):
    text = text_of(post)
    last = replacement.endswith("L Z-1") or "M9" in pattern  # the closing, not the opening
    if last:
        start = len(text) - 300
        broken = text[:start] + re.sub(pattern, replacement, text[start:], count=1, flags=re.M)
    else:
        every = check == "state" and replacement == ""
        broken = re.sub(pattern, replacement, text, count=0 if every else 1, flags=re.M)
    assert broken != text
    found = [one.message for one in checked(broken, post).findings if one.check == check]
    assert any(told in message for message in found), found


def shift(text, letter, amount, after):
    """The text with the first word of that letter behind a place moved by an amount."""
    start = text.index(after)
    moved = re.sub(
        rf"{letter}([+-]?[\d.]+)",
        lambda m: f"{letter}{float(m[1]) + amount:{'+' if '+' in m[1] else ''}.4f}",
        text[start:],
        count=1,
    )
    return text[:start] + moved


@pytest.mark.parametrize(
    "letter, amount", [("X", 0.005), ("Y", -0.005), ("Z", 0.005), ("B", 0.01), ("C", 0.05)]
)
@pytest.mark.parametrize("post", ANGLES)
def test_a_pose_that_is_off_is_found(post, letter, amount):
    result = checked(
        shift(text_of(post), letter, amount, after="X41.0256" if "tnc" not in post else "X+41.0256"), post
    )
    assert any(one.check == "round trip" for one in result.findings)


@pytest.mark.parametrize("letter", ["X", "Y", "Z"])
@pytest.mark.parametrize("post", VECTORS)
def test_a_tip_that_is_off_is_found_beside_vectors(post, letter):
    broken = shift(text_of(post), letter, 0.005, after="X+41.0256" if "tnc" in post else "X41.0256")
    assert any(one.check == "round trip" for one in checked(broken, post).findings)


@pytest.mark.parametrize("post", VECTORS)
def test_a_turned_vector_is_found(post):
    sign = {"tnc_vectors": "TY", "fanuc_vectors": "J", "sinumerik_vectors": "B3="}[post]
    broken = re.sub(rf"{sign}\+?([\d.]+)", rf"{sign}-\1", text_of(post))
    assert broken != text_of(post)
    assert any(one.check == "round trip" for one in checked(broken, post).findings)


@pytest.mark.parametrize("post", ANGLES)
def test_a_machine_that_turns_the_other_way_is_found(post):
    """The tips agree, as the control holds them; only the directions tell."""
    result = checked(text_of(post), post, "linuxcnc_xyzbc")
    assert any(one.check == "round trip" for one in result.findings)


@pytest.mark.parametrize("post", ANGLES)
def test_limits_and_jumps_are_found(post):
    place = "X+41.0256" if "tnc" in post else "X41.0256"
    assert any(
        one.check == "limits" for one in checked(shift(text_of(post), "B", 200.0, after=place), post).findings
    )
    wrapped = checked(shift(text_of(post), "C", -360.0, after=place), post).findings
    assert wrapped and {one.check for one in wrapped} == {"continuity"}  # the direction is the same


def written(folder, post="linuxcnc"):
    program, cl = folder / "p.ngc", folder / "cl.csv"
    program.write_bytes(text_of(post).encode())
    rows = [",".join(f"{v:.9f}" for v in (*t, *a)) for t, a in zip(TIP, AXIS)]
    rows.insert(2, rows[1])  # a plunge and the position where it ends
    cl.write_text("\n".join(["tip_x,tip_y,tip_z,axis_x,axis_y,axis_z", *rows, ""]))
    return str(program), str(cl)


def test_check_command(tmp_path, capsys):
    program, cl = written(tmp_path)
    assert cli.main(["check", program, "--machine", MACHINE, "--post", "linuxcnc", "--against", cl]) == 0
    told = capsys.readouterr().out
    assert "grammar: passed" in told and "round trip: passed, tip error <= 0.0000" in told
    assert cli.main(["check", program, "--machine", MACHINE]) == 0
    assert "not made, no CL file" in capsys.readouterr().out
    assert cli.main(["check", program, "--machine", "linuxcnc_xyzbc", "--against", cl]) == 1
    assert "round trip: " in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments, told",
    [
        (["nowhere.H", "--machine", MACHINE], "nowhere.H: cannot be read"),
        (["{program}", "--machine", "none"], "machine 'none': unknown"),
        (["{program}", "--machine", MACHINE, "--post", "none"], "post 'none': unknown"),
    ],
)
def test_check_command_tells_bad_input(tmp_path, capsys, arguments, told):
    program, _ = written(tmp_path)
    assert cli.main(["check", *(one.replace("{program}", program) for one in arguments)]) == 2
    error = capsys.readouterr().err
    assert told in error and error.count("\n") == 1
