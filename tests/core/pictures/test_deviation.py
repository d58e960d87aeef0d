"""Bands of deviations and their picture."""

from __future__ import annotations

import io

import matplotlib.image
import numpy as np
import pytest

from freecad_mpm.core.pictures import deviation
from freecad_mpm.core.removal import Extreme, bands

COLOURS = bands.COLOURS
BANDS = bands.bands(0.01)


def picture(deviation_mm: np.ndarray) -> np.ndarray:
    """Of a square of 40 x 40 mm, 1 mm between its points."""
    x, y = np.meshgrid(np.arange(41.0), np.arange(41.0))
    points = np.column_stack((x.ravel(), y.ravel(), np.zeros(x.size)))
    node = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    triangles = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    worst = [
        Extreme(float(deviation_mm.min()), points[0], 3),
        Extreme(float(deviation_mm.max()), points[-1], -1),
        None,
    ]
    shown = deviation.Map(points, triangles, deviation_mm, len(points), worst, 1.0)
    png = deviation.render(shown, BANDS, "square")
    return matplotlib.image.imread(io.BytesIO(png))[:, :1050, :3]  # without the key


def share_of(image: np.ndarray, band: int) -> float:
    return float(np.mean(np.abs(image - np.array(COLOURS[band])).max(axis=-1) < 0.02))


def test_the_picture_has_as_much_of_a_colour_as_the_face_of_its_band() -> None:
    x = np.tile(np.arange(41.0), 41)
    deviation_mm = np.where(x <= 10, -0.05, 0.0)
    image = picture(deviation_mm)
    gouged, within = share_of(image, 1), share_of(image, 2)
    # A triangle with one gouged corner counts as gouged: 11 of 40 columns.
    assert gouged / (gouged + within) == pytest.approx(11 / 40, abs=0.02)
    assert gouged + within > 0.3
