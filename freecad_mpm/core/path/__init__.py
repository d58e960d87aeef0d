"""In which order: cuts proven, positions put in between, links, `cl.csv`; and the judge of anyone's path.

Native: `gouge`, `path`. A move that nobody proved is never called proven.
To add a CL format: a writer beside `apt.py`, over `ToolPath`."""

from __future__ import annotations

from . import cl_file
from .apt import to_apt
from .certify import STAGE
from .cl_file import read_csv
from .cuts import prove
from .judge import verify
from .linking import link, link_options
from .tool_path import ToolPath, from_core, path_in_part

__all__ = [
    "STAGE",
    "ToolPath",
    "cl_file",
    "from_core",
    "link",
    "link_options",
    "path_in_part",
    "prove",
    "read_csv",
    "to_apt",
    "verify",
]
