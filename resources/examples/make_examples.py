"""Make the shipped example parts: /usr/bin/python3 resources/examples/make_examples.py [FOLDER]

The thesis' surfaces need the native reader only; the bonnet die is modelled with FreeCAD's Part module. The
same version of OpenCASCADE writes the same bytes."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
FREECAD_LIBRARY = "/usr/lib/freecad-python3/lib"

# The test surfaces of the thesis' table 1: z (mm) of the bicubic Bézier net, P00, P01, …
# P33. x and y of the net are 0, 50, 100, 150.
THESIS_Z_MM = {
    "convex": [80, 90, 90, 80, 90, 105, 105, 90, 90, 105, 105, 90, 80, 90, 90, 80],
    "concave": [80, 70, 70, 80, 70, 55, 55, 70, 70, 55, 55, 70, 80, 70, 70, 80],
    "saddle": [80, 65, 90, 85, 80, 85, 90, 95, 100, 105, 95, 100, 90, 100, 100, 85],
}
THESIS_XY_MM = [0.0, 50.0, 100.0, 150.0]
BEZIER_KNOTS = np.repeat([0.0, 1.0], 4)

# The bonnet die, mm: a crowned plateau with rounded corners on a base plate, with a lifting hole in the
# crown.
PLATEAU_MM = (180.0, 130.0)
CORNER_RADIUS_MM = 22.0
BASE_MM = (210.0, 160.0, 20.0)
SKIN_MARGIN_MM = 15.0  # the skin is modelled larger than the plateau and trimmed by its walls
HOLE_RADIUS_MM = 9.0
HOLE_CENTER_MM = (38.0, 22.0)
HOLE_FLOOR_MM = 40.0
SKIN_KNOTS = [0.0, 1.0, 2.0, 3.0, 4.0]
SKIN_SEAM = 2.0  # the skin is four faces, which meet at this knot in both directions
FIXED_TIME = "2000-01-01T00:00:00"


def thesis_face(name: str) -> dict[str, Any]:
    """One surface of table 1 for _occt.write_step; i of P_ij runs along x, j along y."""
    x, y = np.meshgrid(THESIS_XY_MM, THESIS_XY_MM, indexing="ij")
    poles = np.dstack((x, y, np.reshape(THESIS_Z_MM[name], (4, 4))))
    return {"degree_u": 3, "degree_v": 3, "knots_u": BEZIER_KNOTS, "knots_v": BEZIER_KNOTS, "poles": poles}


def skin_height_mm(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Heights of the die's poles: a crown that falls to the front, two soft ridges along x."""
    crown = 78.0 - (x / 32.0) ** 2 - (y / 24.0) ** 2 - 0.03 * x
    ridge_at = 32.0 + 0.12 * x
    ridges = 4.0 * np.exp(-(((np.abs(y) - ridge_at) / 16.0) ** 2))
    return np.round(crown + ridges, 3)


def skin_faces(part: ModuleType) -> list[Any]:
    count = len(SKIN_KNOTS) + 2
    half_x, half_y = (0.5 * size + SKIN_MARGIN_MM for size in PLATEAU_MM)
    x, y = np.meshgrid(greville(half_x, count), greville(half_y, count), indexing="ij")
    poles = np.dstack((x, y, skin_height_mm(x, y)))
    multiplicities = [4, *[1] * (len(SKIN_KNOTS) - 2), 4]
    skin = part.BSplineSurface()
    skin.buildFromPolesMultsKnots(
        poles.tolist(), multiplicities, multiplicities, SKIN_KNOTS, SKIN_KNOTS, False, False, 3, 3
    )
    halves = ((SKIN_KNOTS[0], SKIN_SEAM), (SKIN_SEAM, SKIN_KNOTS[-1]))
    return [quarter(skin, *u, *v).toShape() for u in halves for v in halves]


def greville(half: float, count: int) -> np.ndarray:
    """Where the poles of a cubic must stand for a coordinate to be linear in the parameter."""
    knots = np.concatenate(([SKIN_KNOTS[0]] * 3, SKIN_KNOTS, [SKIN_KNOTS[-1]] * 3))
    means = np.array([knots[i + 1 : i + 4].mean() for i in range(count)])
    return half * (2 * means / SKIN_KNOTS[-1] - 1)


def quarter(skin: Any, u0: float, u1: float, v0: float, v1: float) -> Any:
    piece = skin.copy()
    piece.segment(u0, u1, v0, v1)
    return piece


def bonnet_die(part: ModuleType, vector: Any) -> Any:
    """The die as a solid: base plate, plateau under the skin, hole."""
    top = part.makeShell(skin_faces(part))
    pieces, _ = plateau(part, vector).generalFuse([top])
    under_skin = min(pieces.Solids, key=lambda solid: solid.CenterOfMass.z)
    hole = part.makeCylinder(HOLE_RADIUS_MM, 100, vector(*HOLE_CENTER_MM, HOLE_FLOOR_MM))
    base = part.makeBox(*BASE_MM, vector(-BASE_MM[0] / 2, -BASE_MM[1] / 2, 0))
    die = under_skin.cut(hole).fuse(base).removeSplitter()
    if not die.isValid() or len(die.Solids) != 1:
        raise RuntimeError("the bonnet die is not one valid solid")
    return die.Solids[0]


def plateau(part: ModuleType, vector: Any) -> Any:
    box = part.makeBox(*PLATEAU_MM, 100, vector(-PLATEAU_MM[0] / 2, -PLATEAU_MM[1] / 2, 0))
    upright = [edge for edge in box.Edges if abs(edge.tangentAt(edge.FirstParameter).z) > 0.5]
    return box.makeFillet(CORNER_RADIUS_MM, upright)


def write_bonnet_die(path: Path) -> None:
    sys.path.append(FREECAD_LIBRARY)
    import FreeCAD
    import Part

    bonnet_die(Part, FreeCAD.Vector).exportStep(str(path))
    text = re.sub(r"'\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d'", f"'{FIXED_TIME}'", path.read_text(encoding="utf-8"))
    path.write_text(text, encoding="utf-8")


def main(folder: Path) -> None:
    sys.path.insert(0, str(ROOT))
    from freecad_mpm import _occt

    for name in THESIS_Z_MM:
        _occt.write_step(str(folder / f"{name}.step"), [thesis_face(name)], name)
    write_bonnet_die(folder / "bonnet_die.step")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
