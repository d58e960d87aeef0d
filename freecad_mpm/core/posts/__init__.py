"""What a program says: one description (`Program`), one small writer a control. It never reads a program.

`load(name)` gives a post, `names()` all of them.
To add a post: one file with FILE_ENDING, DIALECT, JOINTS, OPTIONS and write; one script in `document/posts`."""

from __future__ import annotations

from .options import PostOptions
from .program import PROGRAM_NAME, Program, ProgramTool, program_name
from .registry import Post, load, names

__all__ = ["PROGRAM_NAME", "Post", "PostOptions", "Program", "ProgramTool", "load", "names", "program_name"]
