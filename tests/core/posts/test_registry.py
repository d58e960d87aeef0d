"""Which posts there are: every file that is one, and no other."""

from __future__ import annotations

import pytest

from freecad_mpm.core import posts
from freecad_mpm.core.base import InputError
from freecad_mpm.core.control import dialects


@pytest.mark.parametrize("name", posts.names())
def test_every_post_is_whole_and_can_be_read_back(name: str) -> None:
    post = posts.load(name)
    assert post.name == name and post.file_ending.startswith(".")
    assert post.dialect in dialects.READERS
    assert post.options({}) == posts.PostOptions()


def test_shared_modules_are_no_posts() -> None:
    assert {"dmu80p", "linuxcnc", "apt"} <= set(posts.names())
    assert not {"registry", "options", "program", "writing", "tnc", "iso6983"} & set(posts.names())


def test_an_unknown_post_is_told_those_there_are() -> None:
    with pytest.raises(InputError, match="post 'heidenhain': unknown; give one of apt, dmu80p"):
        posts.load("heidenhain")
