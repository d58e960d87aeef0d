"""`python3 -m MODULE ARGUMENT ...` inside FreeCAD's command line: run as `freecadcmd scripts/in_freecad.py`.

FreeCAD takes no arguments for a script, so MODULE and its arguments come, one a line, in MPM_IN_FREECAD. It
would also run a script that raises a second time and return 0 in the end; this one therefore ends the process
itself, with the status of the module, or CRASHED when it raises.
"""

import os
import runpy
import sys
import traceback

CRASHED = 70  # as sysexits.h has it: an internal error, not an answer of the module


def run_module(words: list[str]) -> int:
    """Runs the module words[0] as a program with the arguments words[1:]; returns its exit status."""
    sys.argv = list(words)
    try:
        runpy.run_module(words[0], run_name="__main__", alter_sys=True)
    except SystemExit as end:
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:
        traceback.print_exc()
        return CRASHED
    return 0


status = run_module(os.environ["MPM_IN_FREECAD"].splitlines())
sys.stdout.flush()
sys.stderr.flush()
os._exit(status)
