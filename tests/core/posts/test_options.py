"""What a post may be asked for: each option shows in the text, the text still passes its reader, and nonsense is
refused."""

import re
from dataclasses import replace
from functools import cache

import pytest
from machine_samples import program_of, two_passes

from freecad_mpm.core import machine, posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control import check_program, dialects
from freecad_mpm.core.posts import PostOptions
from freecad_mpm.core.posts.options import NAMES

KIND, TIP, AXIS, FEED = two_passes()
MACHINE = "table_bc"
TNC = ["dmu80p", "tnc_klartext", "tnc_klartext_tcpm", "tnc_vectors"]
SIEMENS, FANUC = ["sinumerik", "sinumerik_vectors"], ["fanuc", "fanuc_vectors"]


@cache
def program():
    return program_of(KIND, TIP, AXIS, FEED, machine.load(MACHINE))


def text_with(post, **options):
    shop = posts.load(post)
    return shop.write(replace(program(), options=shop.options(options)))


SHOWN = [
    (
        TNC[1:],
        {"path_tolerance_mm": 0.02},
        r"32\.0 TOLERANCE\r\n\d+ CYCL DEF 32\.1 T0\.02\r\n\d+ CYCL DEF 32\.2 HSC-MODE:0 TA0\.05\r",
    ),
    (
        TNC[1:],
        {"path_tolerance_mm": 0.1, "smoothing": "rough", "rotary_tolerance_deg": 0.5},
        r"HSC-MODE:1 TA0\.5\r",
    ),
    (["dmu80p"], {"path_tolerance_mm": 0.02}, r"G62 T0\.02 P01 0 P02 0\.05 \*"),
    (SIEMENS, {"path_tolerance_mm": 0.02}, r"CYCLE832\(0\.02,_ORI_FINISH,0\.05\)"),
    (SIEMENS, {"path_tolerance_mm": 0.02, "smoothing": "rough"}, r"_ORI_ROUGH"),
    (["linuxcnc"], {"path_tolerance_mm": 0.02}, r"^G64 P0\.02 Q0\.02$"),
    (TNC, {"retract": "tool_axis"}, r"M140 MB MAX.*\r\n.*(?:M129|RESET TCPM)"),
    (["dmu80p"], {"tool_change": True}, r"T1 G17 S8000 M6 \*"),
    (["dmu80p"], {"end_block": 99_999_999}, r"N99999999 %MPM01"),
    (FANUC, {"program_number": 4711}, r"^O4711 "),
    (posts.names()[1:], {"coolant": "mist"}, r"\bM7\b|COOLNT/ON"),
    (["fanuc", "linuxcnc", "sinumerik"], {"decimals": 6}, r"X41\.025641 "),
    (["fanuc", "linuxcnc", "sinumerik", *TNC], {"preposition_mm": 250.0}, r"Z\+?290"),
]


@pytest.mark.parametrize("post, options, shown", [(p, o, s) for names, o, s in SHOWN for p in names])
def test_an_option_shows_and_the_program_still_passes(post, options, shown):
    text = text_with(post, **options)
    assert re.search(shown, text, re.M)
    assert not re.search(shown, text_with(post), re.M) or post == "apt"
    result = check_program(dialects.read(text, posts.load(post).dialect), machine.load(MACHINE), TIP, AXIS)
    assert result.findings == []


@pytest.mark.parametrize("post", TNC)
def test_the_blank_and_the_comment_can_be_left_out(post):
    text = text_with(post, blank=False, comments=False)
    assert "BLK FORM" not in text and "G30" not in text and ";" not in text


@pytest.mark.parametrize("post", [name for name in posts.names() if name != "apt"])
def test_coolant_off_is_off(post):
    assert not re.search(r"\bM[78]\b", text_with(post, coolant="off"))


@pytest.mark.parametrize("post", posts.names())
def test_an_option_that_a_post_does_not_read_is_refused(post):
    known = posts.load(post).option_names
    assert known <= set(NAMES)
    for name in set(NAMES) - known:
        with pytest.raises(
            InputError, match=rf"\[post.options\] {name}: the post {post} has no use for it; it reads"
        ):
            posts.load(post).options({name: getattr(PostOptions(), name)})


@pytest.mark.parametrize(
    "options, told",
    [
        ({"decimal": 3}, r"decimal: unknown key; did you mean decimals\?"),
        ({"decimals": 2}, "decimals: must be a whole number from 3 to 9, got 2"),
        ({"coolant": "on"}, 'coolant: must be "flood" or "mist" or "off"'),
        ({"path_tolerance_mm": -1}, "path_tolerance_mm: must be zero or a positive number of mm"),
    ],
)
def test_a_wrong_option_is_told(options, told):
    with pytest.raises(InputError, match=told):
        posts.load("tnc_klartext").options(options)


@pytest.mark.parametrize("post", TNC)
def test_a_tnc_takes_four_decimals_at_most(post):
    with pytest.raises(InputError, match="decimals: must be 4 or less"):
        text_with(post, decimals=5)


@pytest.mark.parametrize(
    "old, new", [("32.1 T0.02", "32.1 T-1"), ("HSC-MODE:0", "HSC-MODE:2"), ("M140 MB MAX", "M140 MB")]
)
def test_a_wrong_cycle_is_found(old, new):
    text = text_with("tnc_klartext", path_tolerance_mm=0.02, retract="tool_axis")
    assert old in text
    broken = dialects.read(text.replace(old, new), "klartext")
    assert any("is no block of the control" in message for _, _, message in broken.grammar)
