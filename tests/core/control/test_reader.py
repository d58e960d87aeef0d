"""The text read as a control would."""

from __future__ import annotations

import numpy as np
from machine_samples import program_of, two_passes

from freecad_mpm.core.control.dialects.din_iso import read
from freecad_mpm.core.posts.dmu80p import write

KIND, TIP, AXIS, FEED = two_passes()
GOOD = write(program_of(KIND, TIP, AXIS, FEED))


def test_reader_keeps_the_state_a_control_would_have():
    program = read(GOOD)
    assert program.name == "MPM01"
    by_text = {block.text.partition(" ")[2]: block for block in program.blocks}
    assert by_text["M128 *"].tcp
    last = [block for block in program.blocks if 129 in block.m][-1]
    assert last.tcp and not program.blocks[program.blocks.index(last) + 1].tcp  # off at the end of its block
    assert np.isnan(program.blocks[-2].position[:3]).all()  # retracted in the machine's own coordinates
    cuts = [block for block in program.blocks if block.rapid is False and block.moves]
    assert {block.feed for block in cuts} == {300.0, 1500.0, 500.0}
    assert all(block.spindle for block in cuts) and not program.blocks[-1].spindle


def test_incremental_words_are_added():
    program = read("%X G71 *\r\nN1 G00 G40 G90 X+5 *\r\nN2 G91 X+2 *\r\nN3 X+2 *\r\nN9 %X G71 *\r\n")
    assert [block.position[0] for block in program.blocks] == [5.0, 7.0, 9.0]
