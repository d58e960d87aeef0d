"""Drop and tilt by brute force, in numpy alone: nothing of the core is used, nothing is clever.

One bicubic patch over [0, 1]^2; lengths mm, angles rad."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRID = 160  # points along a side of the window under the tool
NEAR_MM = 0.02  # local minima of the gap with more than this on the grid are no contacts
INSIDE_MM = 1e-9  # a gap below minus this is a touch
ZOOMS, ZOOM = 14, 0.25
BISECTIONS = 32


@dataclass(frozen=True)
class Reference:
    tilt: float
    contact: Array  # the first one


class Patch:
    """A bicubic Bézier patch; poles (4, 4, 3)."""

    def __init__(self, poles: Array) -> None:
        self.poles = poles

    def points(self, u: Array, v: Array) -> Array:
        """(..., 3) for u and v of one shape."""

        def basis(t: Array) -> Array:
            s = 1 - t
            return np.stack([s**3, 3 * s * s * t, 3 * s * t * t, t**3], axis=-1)

        return np.einsum("...i,...j,ijk->...k", basis(u), basis(v), self.poles)


def window(center: tuple[float, float], half: float, count: int) -> tuple[Array, Array]:
    """Parameters of a grid round `center`, as much of the square as lies on the patch."""
    u, v = (np.linspace(max(c - half, 0), min(c + half, 1), count) for c in center)
    grid_u, grid_v = np.meshgrid(u, v, indexing="ij")
    return grid_u, grid_v


def zoomed(value, patch: Patch, u: float, v: float, half: float) -> tuple[float, Array]:
    """Least value(points) near (u, v), and its point, by ever finer grids."""
    for _ in range(ZOOMS):
        grid_u, grid_v = window((u, v), half, 17)
        points = patch.points(grid_u, grid_v)
        values = value(points)
        at = np.unravel_index(np.argmin(values), values.shape)
        u, v, half = grid_u[at], grid_v[at], half * ZOOM
    return float(values[at]), points[at]


def local_minima(values: Array) -> list[tuple[int, int]]:
    padded = np.pad(values, 1, constant_values=np.inf)
    lowest = np.ones(values.shape, dtype=bool)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            lowest &= values <= padded[1 + i : 1 + i + values.shape[0], 1 + j : 1 + j + values.shape[1]]
    return [tuple(at) for at in np.argwhere(lowest & (values < NEAR_MM))]


def tilt_of(
    patch: Patch, at: tuple[float, float], size_mm: float, major: float, minor: float, most: float
) -> Reference:
    """The greatest tilt up to `most` at which no point of the patch is deeper than INSIDE_MM in the ring; the tool is
    dropped over plan point `at` first. size_mm: side of the patch in plan, over which it is nearly uniform.
    """
    half = 1.1 * (major + minor) / size_mm
    grid_u, grid_v = window((at[0] / size_mm, at[1] / size_mm), half, GRID)
    points = patch.points(grid_u, grid_v)
    cell = 2 * half / (GRID - 1)

    def under(s: Array) -> Array:
        a = np.hypot(s[..., 0] - at[0], s[..., 1] - at[1]) - major
        return -np.where(np.abs(a) <= minor, s[..., 2] + np.sqrt(np.maximum(minor**2 - a * a, 0)), -np.inf)

    start = np.unravel_index(np.argmin(under(points)), grid_u.shape)
    height, first = zoomed(under, patch, grid_u[start], grid_v[start], 2 * cell)
    center = np.array([at[0], at[1], -height])
    inward = np.append((center - first)[:2], 0)
    inward /= np.linalg.norm(inward)
    insert, up = center - major * inward, np.array([0.0, 0.0, 1.0])

    def is_free(tilt: float) -> bool:
        middle = insert + major * (np.cos(tilt) * inward - np.sin(tilt) * up)
        axis = np.cos(tilt) * up + np.sin(tilt) * inward

        def gap(s: Array) -> Array:
            x = s - middle
            z = x @ axis
            r = np.sqrt(np.maximum(np.einsum("...i,...i", x, x) - z * z, 0))
            return np.hypot(r - major, z) - minor

        values = gap(points)
        if values.min() < -INSIDE_MM:
            return False
        minima = local_minima(values)
        return all(zoomed(gap, patch, grid_u[m], grid_v[m], 2 * cell)[0] >= -INSIDE_MM for m in minima)

    low, high = 0.0, most
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_free(middle) else (low, middle)
    return Reference(low, first)
