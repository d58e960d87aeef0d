"""Makes the checkout importable, as FreeCAD does with an add-on's folder."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
