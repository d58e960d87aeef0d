"""`python3 -m freecad_mpm`: the command line (docs/command-line.md)."""

import sys

from .core.commands import main

sys.exit(main())
