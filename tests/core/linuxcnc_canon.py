"""Runs a program through LinuxCNC's interpreter (its Python module gcode) and keeps the canonical moves in full
precision.

linuxcnc_canon.py PROGRAM TOOL_TABLE OUT.npy: a row a move of X Y Z in mm, A B C in degrees, 1 for a traverse, 1 after
M428. It needs INI_FILE_NAME and a HOME that may be written to; it is a program of its own because the module ends the
process when it does not like its surroundings."""

import ctypes
import re
import sys
from pathlib import Path

import gcode
import numpy as np

MM_PER_INCH = 25.4
TCP = {"tcp_on": True, "tcp_off": False}  # comments of the subroutines that switch the kinematics
TOOL_FIELDS = 14


class Canon:
    """What the interpreter calls. Everything that is not a move is taken and forgotten."""

    parameter_file = "rs.var"
    random_toolchanger = 0

    def __init__(self, tool_length):
        self.tool_length, self.tcp, self.rows = tool_length, False, []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return lambda *arguments: None

    def straight_traverse(self, *ends):
        self._move(ends, 1)

    def straight_feed(self, *ends):
        self._move(ends, 0)

    def _move(self, ends, traverse):
        self.rows.append([*(v * MM_PER_INCH for v in ends[:3]), *ends[3:6], traverse, self.tcp])

    def comment(self, text):
        self.tcp = TCP.get(text, self.tcp)

    def get_external_length_units(self):
        return 1.0  # the machine's unit is the mm

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 0b111111

    def get_block_delete(self):
        return False

    def check_abort(self):
        return False

    def get_tool(self, number):
        return (number, 0.0, 0.0, self.tool_length) + (0.0,) * (TOOL_FIELDS - 5) + (0,)


def load_tool_table(path):
    """Without a tool table in memory the interpreter crashes at T."""
    library = ctypes.CDLL("libtooldata.so.0", mode=ctypes.RTLD_GLOBAL)
    library._Z17tool_mmap_creatorPK13EMC_TOOL_STATi(None, 0)
    library._Z13tooldata_initb(0)
    if library._Z13tooldata_loadPKcPPc(path.encode(), None):
        sys.exit(f"{path}: cannot be read")


def main(program, tools, out):
    tool_length = float(re.search(r"Z([\d.]+)", Path(tools).read_text())[1])
    load_tool_table(tools)
    canon = Canon(tool_length)
    status, line = gcode.parse(program, canon, "G21", "")
    if status > gcode.MIN_ERROR:
        sys.exit(f"{program}:{line}: {gcode.strerror(status)}")
    np.save(out, np.array(canon.rows, dtype=float))


main(*sys.argv[1:])
