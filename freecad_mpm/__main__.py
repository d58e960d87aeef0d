"""`python3 -m freecad_mpm`: the command line (docs/command-line.md)."""

import sys

from .core.cli import main

sys.exit(main())
