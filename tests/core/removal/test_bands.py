"""Bands of deviations and their words."""

from __future__ import annotations

import numpy as np
import pytest

from freecad_mpm.core.removal import bands

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
