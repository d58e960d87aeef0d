"""Bands of deviations and their picture."""

from __future__ import annotations

import io

import matplotlib.image
import numpy as np
import pytest

from freecad_mpm.core import deviation_bands, deviation_picture

BANDS = deviation_bands.bands(0.01)


@pytest.mark.parametrize(
    ("deviation_mm", "move", "name"),
    [
        (-0.2, 3, "below -0.1 mm"),
        (-0.05, 3, "-0.1 mm to -10 µm"),
        (-0.0099, 3, "-10 µm to +10 µm"),
        (0.0, 0, "-10 µm to +10 µm"),
        (0.03, 3, "+10 µm to +50 µm"),
        (0.9, 3, "+0.2 mm to +1 mm"),
        (7.0, 3, "above +1 mm"),
        (7.0, -1, "not cut by any move"),
    ],
)
def test_the_band_of_a_deviation(deviation_mm: float, move: int, name: str) -> None:
    band = BANDS.of(np.array([deviation_mm]), np.array([move]))[0]
    assert BANDS.names[band] == name


def test_there_is_a_colour_for_every_band() -> None:
    assert len(BANDS.names) == len(BANDS.colours) == len(set(BANDS.colours))


def test_shares_and_their_words() -> None:
    deviation_mm = np.array([0.0] * 2999 + [-0.05])
    shares = BANDS.shares(deviation_mm, np.zeros(3000, dtype=int))
    assert sum(shares) == pytest.approx(1)
    assert deviation_bands.table(BANDS, shares) == ["-0.1 mm to -10 µm: < 0.1 %", "-10 µm to +10 µm: 100.0 %"]


def test_a_tolerance_of_zero_still_has_bands() -> None:
    assert (np.diff(deviation_bands.bands(0.0).edges) > 0).all()


def picture(deviation_mm: np.ndarray, move: np.ndarray) -> np.ndarray:
    """Of a square of 40 x 40 mm, 1 mm between its points."""
    x, y = np.meshgrid(np.arange(41.0), np.arange(41.0))
    points = np.column_stack((x.ravel(), y.ravel(), np.zeros(x.size)))
    node = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (part.ravel() for part in (node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]))
    triangles = np.concatenate((np.column_stack((a, b, c)), np.column_stack((a, c, d))))
    png = deviation_picture.render(points, triangles, deviation_mm, move, BANDS, "square")
    return matplotlib.image.imread(io.BytesIO(png))[:, :950, :3]  # without the key


def share_of(image: np.ndarray, band: int) -> float:
    return float(np.mean(np.abs(image - np.array(BANDS.colours[band])).max(axis=-1) < 0.02))


def test_the_picture_has_as_much_of_a_colour_as_the_face_of_its_band() -> None:
    x = np.tile(np.arange(41.0), 41)
    deviation_mm = np.where(x <= 10, -0.05, 0.0)
    image = picture(deviation_mm, np.zeros(len(x), dtype=int))
    gouged, within = share_of(image, 1), share_of(image, 2)
    # A triangle with one gouged corner counts as gouged: 11 of 40 columns.
    assert gouged / (gouged + within) == pytest.approx(11 / 40, abs=0.02)
    assert gouged + within > 0.3


def test_what_no_move_cut_is_grey() -> None:
    image = picture(np.full(41 * 41, 5.0), np.full(41 * 41, -1))
    assert share_of(image, len(BANDS.colours) - 1) > 0.3
