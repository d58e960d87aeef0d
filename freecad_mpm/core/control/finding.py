"""What a check of a program has to say: which check, where, and what."""

from __future__ import annotations

from dataclasses import dataclass

from .reader import Motion, ParsedProgram


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong: which check found it, where, and what."""

    check: str
    block: int | None
    text: str
    message: str

    def __str__(self) -> str:
        return ": ".join(filter(None, (self.check, self.text, self.message)))


def finding_at(check: str, program: ParsedProgram, motion: Motion, row: int, message: str) -> Finding:
    """Of the block of a row of the program's motion."""
    block = program.blocks[motion.block[row]]
    return Finding(check, block.number, block.text, message)
