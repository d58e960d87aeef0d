"""Whether the machine is in the right state for every block of a program."""

from __future__ import annotations

from .control import Control
from .finding import Finding
from .reader import Block, ParsedProgram


def check_state(program: ParsedProgram, control: Control = Control()) -> list[Finding]:
    """The machine is in the right state for every block: spindle, feed, tool-centre-point control, absolute words. In a
    program of joint positions that control must stay off."""
    findings = [
        Finding("state", block.number, block.text, message)
        for before, block in zip([None, *program.blocks], program.blocks)
        for message in _state_faults(before, block, control)
    ]
    if program.blocks and program.blocks[-1].tcp and 129 not in program.blocks[-1].m:
        findings.append(
            Finding("state", program.blocks[-1].number, "", "M128 is on at the end: M129 is missing")
        )
    return findings


def _state_faults(before: Block | None, block: Block, control: Control) -> list[str]:
    faults = []
    if "T" in block.words and block.tcp:
        faults.append("a tool call while M128 is on")
    if block.machine_datum and block.tcp:
        faults.append("M91 or M92 while M128 is on")
    if block.tcp and not control.tcp:
        faults.append("M128 is on in a program of joint positions")
    return faults + (_move_faults(before, block, control) if block.moves else [])


def _move_faults(before: Block | None, block: Block, control: Control) -> list[str]:
    faults = []
    if block.absolute is not True:
        faults.append("a move that is not absolute: G90 must be on")
    if not block.compensation_off:
        faults.append("a move before G40: radius compensation may be on")
    if block.rapid is None:
        faults.append("a move without G00 or G01")
    turns = any(letter in block.words for letter in "ABC") or _new_vector(before, block)
    if block.rapid is False:
        faults += _feed_faults(block, control, turns)
    elif turns and before is not None and _travels(before, block) and _turns(before, block):
        faults.append("a rapid that turns and travels at once: its way is not straight")
    return faults


def _new_vector(before: Block | None, block: Block) -> bool:
    # The first vector of a program stands over the first pose, where the tip is held.
    return block.axis is not None and before is not None and before.axis not in (None, block.axis)


def _feed_faults(block: Block, control: Control, turns: bool) -> list[str]:
    faults = []
    if control.spindle and not block.spindle:
        faults.append("a feed move with the spindle off")
    if not block.feed > 0:
        faults.append("a feed move before any F")
    if turns and control.tcp and not block.tcp:
        faults.append("rotary axes in a feed move without M128")
    return faults


def _turns(before: Block, block: Block) -> bool:
    return _new_vector(before, block) or before.position[3:] != block.position[3:]


def _travels(before: Block, block: Block) -> bool:
    if not any(letter in block.words for letter in "XYZ"):
        return False
    if block.tcp:
        return any(a != b for a, b in zip(before.position[:3], block.position[:3]))
    return any(a != b for a, b in zip(before.linear, block.linear))
