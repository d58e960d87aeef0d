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


@pytest.mark.parametrize(
    ("deviation_mm", "name"),
    [
        (-0.2, "below -0.1 mm"),
        (-0.05, "-0.1 mm to -10 µm"),
        (-0.0099, "-10 µm to +10 µm"),
        (0.0, "-10 µm to +10 µm"),
        (0.03, "+10 µm to +50 µm"),
        (0.9, "+0.2 mm to +1 mm"),
        (7.0, "above +1 mm"),
    ],
)
def test_the_band_of_a_deviation(deviation_mm: float, name: str) -> None:
    band = BANDS.of(np.array([deviation_mm]))[0]
    assert BANDS.names[band] == name


def test_there_is_a_colour_for_every_band() -> None:
    assert len(BANDS.names) == len(COLOURS) == len(set(COLOURS))


def test_shares_and_their_words() -> None:
    deviation_mm = np.array([0.0] * 2999 + [-0.05])
    shares = BANDS.shares(deviation_mm)
    assert sum(shares) == pytest.approx(1)
    assert bands.table(BANDS, shares) == ["-0.1 mm to -10 µm: < 0.1 %", "-10 µm to +10 µm: 100.0 %"]


def test_a_tolerance_of_zero_still_has_bands() -> None:
    assert (np.diff(bands.bands(0.0).edges) > 0).all()


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
