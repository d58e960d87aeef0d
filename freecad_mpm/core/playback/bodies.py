"""How the bodies of a machine move: from joint readings to placements of part, rotary members and spindle.

docs/machine.md explains the chain. Everything is in the set-up frame as it stands with all rotary axes at zero, so that
with the machine at rest the part is where the job has it. Heads are described from the spindle gauge point."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from ..base import Floats
from ..machine import Machine, RotaryAxis

Placements = Mapping[str, Floats]

# Bodies besides the rotary members, which have the letters of their axes.
PART, RAM, SPINDLE, TOOL = "part", "ram", "spindle", "tool"
# Directions nearer to each other than this (sine of their angle) are the same: a cross product of them says nothing.
PARALLEL = 1e-12


def body_matrices(machine: Machine, rotary_deg: ArrayLike, linear_mm: ArrayLike) -> dict[str, Floats]:
    """Body -> matrix (4, 4) from its place with all joints at zero to where it is at these readings.

    rotary_deg (2,): of the rotary axes, from the part to the tool; linear_mm (3,): X, Y, Z of the gauge point.
    part:    what is clamped on the table, with the part; the same as the first table's letter, if there is one.
    letters: a table turns with the tables between it and the bed, a head with the ram and the heads above it.
    ram:     what only travels; its geometry, like that of heads and spindle, is given from the gauge point.
    spindle: the last head, or the ram when both rotary axes are tables.
    tool:    from a tool with its tip at the origin and its axis along +z."""
    part_origin = np.asarray(machine.setup.part_origin_mm)
    angles = np.asarray(rotary_deg, dtype=np.float64)
    result = _tables(machine, angles, part_origin)
    result[RAM] = translation(np.asarray(linear_mm, dtype=np.float64) - part_origin)
    result |= _heads(machine, angles, result[RAM])
    result[TOOL] = result[SPINDLE] @ tool_in_spindle(machine)
    return result


def seen_from_part(bodies: Placements) -> dict[str, Floats]:
    """The same with the part at rest: the machine turns round it."""
    back = inverse(bodies[PART])
    return {name: back @ matrix for name, matrix in bodies.items()}


def tool_in_spindle(machine: Machine) -> Floats:
    """From the tool's own frame, tip at the origin and axis along +z, to the gauge point's with rotary axes at zero."""
    axis = unit(machine.kinematics.spindle_axis)
    matrix = turned_to(axis)
    matrix[:3, 3] = -machine.setup.tool_length_mm * axis
    return matrix


def _tables(machine: Machine, rotary_deg: Floats, part_origin: Floats) -> dict[str, Floats]:
    """A positive reading moves the tool round the part: the table turns the other way."""
    result, matrix = {}, np.eye(4)
    for axis, angle in reversed(list(zip(machine.rotary_axes, rotary_deg))):
        if axis.role == "table_rotary":
            matrix = matrix @ inverse(
                _turn(axis, float(angle), np.asarray(axis.joint_origin_mm) - part_origin)
            )
            result[axis.name] = matrix
    result[PART] = matrix
    return result


def _heads(machine: Machine, rotary_deg: Floats, ram: Floats) -> dict[str, Floats]:
    result, matrix = {}, ram
    for axis, angle in zip(machine.rotary_axes, rotary_deg):
        if axis.role == "head_rotary":
            matrix = matrix @ _turn(axis, float(angle), np.asarray(axis.joint_origin_mm))
            result[axis.name] = matrix
    result[SPINDLE] = matrix
    return result


def _turn(axis: RotaryAxis, reading_deg: float, origin: Floats) -> Floats:
    angle = np.radians(axis.sense * (reading_deg - axis.zero_offset_deg))
    return rotation(unit(axis.rotation_vector), float(angle), origin)


def rotation(direction: Floats, angle: float, origin: ArrayLike = (0.0, 0.0, 0.0)) -> Floats:
    """Matrix (4, 4) of the turn by `angle`, radians, about the unit `direction` through `origin` (Rodrigues)."""
    x, y, z = direction
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross
    matrix[:3, 3] = origin - matrix[:3, :3] @ np.asarray(origin)
    return matrix


def turned_to(direction: Floats) -> Floats:
    """A rotation (4, 4) that takes +z to the unit `direction` by the shortest way."""
    across = np.array([-direction[1], direction[0], 0.0])
    sine = float(np.linalg.norm(across))
    if sine < PARALLEL:
        return np.eye(4) if direction[2] > 0 else rotation(np.array([1.0, 0.0, 0.0]), np.pi)
    return rotation(across / sine, float(np.arctan2(sine, direction[2])))


def translation(offset: Floats) -> Floats:
    """(4, 4) that shifts by `offset` (3,) mm."""
    matrix = np.eye(4)
    matrix[:3, 3] = offset
    return matrix


def inverse(matrix: Floats) -> Floats:
    """Of a matrix (4, 4) that turns and shifts."""
    back = np.eye(4)
    back[:3, :3] = matrix[:3, :3].T
    back[:3, 3] = -matrix[:3, :3].T @ matrix[:3, 3]
    return back


def unit(vector: ArrayLike) -> Floats:
    """The direction of a vector (3,), length 1; NaN for the zero vector."""
    return np.asarray(vector, dtype=np.float64) / np.linalg.norm(vector)
