"""Our evaluation of B-spline surfaces against OpenCASCADE's and against exact arithmetic, to rounding."""

from __future__ import annotations

from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from part_samples import EXAMPLES, shared

from freecad_mpm import _core, _occt
from freecad_mpm.core.part import FaceArrays
from freecad_mpm.core.part.file import read_part

SAMPLES = 200
EPS = np.finfo(float).eps
# What one value may be off by, in units of EPS times the coordinates. Measured against exact arithmetic ours
# stays below 2 at every degree.
OUR_ROUNDINGS = 8
# OpenCASCADE expands a knot span into a Taylor polynomial: measured, 3 at degree 3 but 10^4 at degree 10,
# twice as much a degree.
THEIR_ROUNDINGS = 16
ORDERS = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]  # of S, Su, Sv, Suu, Suv, Svv


def arrays(face: FaceArrays) -> tuple:
    return (face.degree_u, face.degree_v, face.knots_u, face.knots_v, face.poles, face.weights)


def domain(knots: np.ndarray, degree: int) -> tuple[float, float]:
    return knots[degree], knots[-degree - 1]


def narrowest_span(knots: np.ndarray, degree: int) -> np.ndarray:
    inside = knots[degree : len(knots) - degree]
    widths = np.diff(inside)
    return widths[widths > 0].min()


def rounding(face: FaceArrays) -> np.ndarray:
    """What rounding may do to S and its derivatives (6,), mm per unit of parameter.

    A derivative is a difference of values over a knot span times the degree, so an error of eps times the
    coordinates grows by degree/span with each order; a quotient adds a factor of the ratio of the weights
    with each order."""
    size = np.abs(face.poles).max()
    ratio = 1.0 if face.weights is None else face.weights.max() / face.weights.min()
    rate_u = face.degree_u / narrowest_span(face.knots_u, face.degree_u)
    rate_v = face.degree_v / narrowest_span(face.knots_v, face.degree_v)
    growth = [(ratio * rate_u) ** a * (ratio * rate_v) ** b for a, b in ORDERS]
    roundings = THEIR_ROUNDINGS * 2 ** max(face.degree_u, face.degree_v)
    return roundings * EPS * size * ratio * np.array(growth)


def expect_equal(face: FaceArrays, random: np.random.Generator) -> None:
    u = random.uniform(*domain(face.knots_u, face.degree_u), SAMPLES)
    v = random.uniform(*domain(face.knots_v, face.degree_v), SAMPLES)
    ours = _core.BSplineSurface(*arrays(face)).evaluate(u, v)
    theirs = _occt.evaluate(*arrays(face), u, v)
    difference = np.abs(ours - theirs).max(axis=(0, 2))
    assert (difference <= rounding(face)).all(), f"{face.name}: {difference} over {rounding(face)}"


EXAMPLE_FILES = sorted(EXAMPLES.glob("*.step"))


def test_there_are_examples():
    assert len(EXAMPLE_FILES) >= 4


@pytest.mark.parametrize("path", EXAMPLE_FILES, ids=lambda path: path.stem)
def test_every_example(path):
    random = np.random.default_rng(1)
    for face in read_part(path):
        expect_equal(face, random)


@pytest.mark.parametrize("name", ["teapot.txt", "nacelle.stp", "hammer.iges"])
def test_parts_that_nobody_here_made(name):
    random = np.random.default_rng(2)
    for face in read_part(shared(name)):
        expect_equal(face, random)


def random_knots(random: np.random.Generator, degree: int, clamped: bool) -> np.ndarray:
    """Interior knots of any multiplicity up to the degree; ends clamped, or running on with simple knots."""
    interior = np.cumsum(random.uniform(0.2, 1.0, random.integers(0, 4))) - 2.0
    middle = np.repeat(interior, random.integers(1, degree + 1, len(interior)))
    end = (interior[-1] if len(interior) else -2.0) + 0.5
    if clamped:
        return np.concatenate((np.repeat(-2.5, degree + 1), middle, np.repeat(end, degree + 1)))
    steps = 0.3 * np.arange(degree + 1)
    return np.concatenate((-2.5 - steps[::-1], middle, end + steps))


def random_face(
    random: np.random.Generator, degrees: tuple[int, int], rational: bool, clamped: bool
) -> FaceArrays:
    ku, kv = (random_knots(random, degree, clamped) for degree in degrees)
    shape = (len(ku) - degrees[0] - 1, len(kv) - degrees[1] - 1)
    poles = random.uniform(-100, 100, (*shape, 3))
    weights = random.uniform(0.5, 2, shape) if rational else None
    return FaceArrays(f"{degrees[0]}x{degrees[1]}", "bspline", *degrees, ku, kv, poles, weights)


ALL_SURFACES = [
    pytest.mark.parametrize("clamped", [True, False], ids=["clamped", "unclamped"]),
    pytest.mark.parametrize("rational", [True, False], ids=["rational", "polynomial"]),
    pytest.mark.parametrize("degree", range(1, 11)),
]


def for_all_surfaces(test):
    for mark in ALL_SURFACES:
        test = mark(test)
    return test


@for_all_surfaces
def test_random_surfaces(degree, rational, clamped):
    random = np.random.default_rng([degree, rational, clamped])
    for other in range(1, 11):
        expect_equal(random_face(random, (degree, other), rational, clamped), random)


@cache
def exact_basis(knots: tuple[Fraction, ...], degree: int, index: int, t: Fraction) -> Fraction:
    """A B-spline basis function by its recursive definition."""
    if degree == 0:
        return Fraction(knots[index] <= t < knots[index + 1])
    result = Fraction(0)
    left, right = knots[index + degree] - knots[index], knots[index + degree + 1] - knots[index + 1]
    if left:
        result += (t - knots[index]) / left * exact_basis(knots, degree - 1, index, t)
    if right:
        result += (knots[index + degree + 1] - t) / right * exact_basis(knots, degree - 1, index + 1, t)
    return result


def exact_row(knots: np.ndarray, degree: int, t: float) -> list[Fraction]:
    exact = tuple(Fraction(float(knot)) for knot in knots)
    return [exact_basis(exact, degree, index, Fraction(t)) for index in range(len(knots) - degree - 1)]


def exact_point(face: FaceArrays, u: float, v: float) -> np.ndarray:
    row, column = exact_row(face.knots_u, face.degree_u, u), exact_row(face.knots_v, face.degree_v, v)
    total = [Fraction(0)] * 4
    for i, a in enumerate(row):
        for j, b in enumerate(column):
            factor = a * b * (1 if face.weights is None else Fraction(face.weights[i, j]))
            pole = [*map(Fraction, face.poles[i, j]), Fraction(1)]
            total = [sum_ + factor * one for sum_, one in zip(total, pole)]
    return np.array([float(sum_ / total[3]) for sum_ in total[:3]])


@for_all_surfaces
def test_points_are_exact_to_rounding(degree, rational, clamped):
    random = np.random.default_rng([degree, rational, clamped])
    face = random_face(random, (degree, 1 + (degree + 4) % 10), rational, clamped)
    tolerance = OUR_ROUNDINGS * EPS * np.abs(face.poles).max()
    for _ in range(3):
        u = random.uniform(*domain(face.knots_u, face.degree_u))
        v = random.uniform(*domain(face.knots_v, face.degree_v))
        ours = _core.BSplineSurface(*arrays(face)).evaluate([u], [v])[0, 0]
        np.testing.assert_allclose(ours, exact_point(face, u, v), rtol=0, atol=tolerance)
