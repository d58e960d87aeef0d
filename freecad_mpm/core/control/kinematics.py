"""Kinematics for the checks, in numpy: written apart from the native ones, so that each can find the other wrong."""

from __future__ import annotations

import numpy as np

from ..base import Floats
from ..machine import Machine, RotaryAxis

# Under this a great circle and its chord are the same to the last digit.
SMALL_SINE = 1e-8


def tool_axes(machine: Machine, rotary_deg: Floats) -> Floats:
    """Unit tool axes (N, 3) in the part's frame at rotary readings (N, 2)."""
    axes = np.tile(_unit(machine.kinematics.spindle_axis), (len(rotary_deg), 1))
    for k in (1, 0):
        axes = _turned(machine.rotary_axes[k], rotary_deg[:, k], axes)
    return axes


def linear_readings(
    machine: Machine, tip: Floats, rotary_deg: Floats, part_origin_mm: Floats, tool_length_mm: float
) -> Floats:
    """X, Y, Z (N, 3) of the spindle gauge point for tips (N, 3) at rotary readings (N, 2)."""
    at_tool = np.tile(-tool_length_mm * _unit(machine.kinematics.spindle_axis), (len(tip), 1))
    on_table = np.asarray(tip) + part_origin_mm
    for k in (1, 0):
        if machine.rotary_axes[k].role == "head_rotary":
            at_tool = _turned_about_line(machine.rotary_axes[k], rotary_deg[:, k], at_tool)
    for k in (0, 1):
        if machine.rotary_axes[k].role == "table_rotary":
            on_table = _turned_about_line(machine.rotary_axes[k], rotary_deg[:, k], on_table, back=True)
    return np.asarray(on_table - at_tool)


def tips(
    machine: Machine, linear: Floats, rotary_deg: Floats, part_origin_mm: Floats, tool_length_mm: float
) -> Floats:
    """Tips (N, 3) in the part's frame at readings of the linear (N, 3) and rotary (N, 2) axes."""
    at_tool = np.tile(-tool_length_mm * _unit(machine.kinematics.spindle_axis), (len(linear), 1))
    for k in (1, 0):
        if machine.rotary_axes[k].role == "head_rotary":
            at_tool = _turned_about_line(machine.rotary_axes[k], rotary_deg[:, k], at_tool)
    in_part = np.asarray(linear) + at_tool
    for k in (1, 0):
        if machine.rotary_axes[k].role == "table_rotary":
            in_part = _turned_about_line(machine.rotary_axes[k], rotary_deg[:, k], in_part)
    return np.asarray(in_part - part_origin_mm)


def datum_mm(machine: Machine, part_origin_mm: Floats, tool_length_mm: float) -> Floats:
    """What a control without tool-centre-point control takes off the readings of X, Y and Z: datum and tool length."""
    return np.asarray(part_origin_mm + tool_length_mm * _unit(machine.kinematics.spindle_axis))


def solution_side(machine: Machine, rotary_deg: Floats) -> Floats:
    """A number (N,) whose sign tells the two rotary solutions apart; 0 where they meet (pole and end of reach)."""
    first, second = (_unit(axis.rotation_vector) for axis in machine.rotary_axes)
    seconds = np.tile(second, (len(rotary_deg), 1))
    carried = _turned(machine.rotary_axes[0], rotary_deg[:, 0], seconds)
    return np.asarray(np.einsum("ij,ij->i", tool_axes(machine, rotary_deg), np.cross(first, carried)))


def pole_distance_deg(machine: Machine, axes: Floats) -> Floats:
    """Angle (N,) between the tool and the line of the first rotary axis."""
    first = _unit(machine.rotary_axes[0].rotation_vector)
    return np.asarray(
        np.degrees(np.arctan2(np.linalg.norm(np.cross(axes, first), axis=1), np.abs(axes @ first)))
    )


def angles_between_deg(a: Floats, b: Floats) -> Floats:
    """Angles (N,) between the directions a (N, 3) and b (N, 3)."""
    return np.asarray(
        np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b), axis=1), np.einsum("ij,ij->i", a, b)))
    )


def great_circle(a: Floats, b: Floats, s: float) -> Floats:
    """Directions (N, 3) a fraction s of the way from a (N, 3) to b (N, 3), which are not opposite."""
    angle = np.radians(angles_between_deg(a, b))[:, None]
    sine = np.sin(angle)
    small = sine < SMALL_SINE
    sine = np.where(small, 1.0, sine)
    from_a = np.where(small, 1.0 - s, np.sin((1.0 - s) * angle) / sine)
    from_b = np.where(small, s, np.sin(s * angle) / sine)
    return np.asarray(from_a * a + from_b * b)


def _unit(vector: tuple[float, float, float]) -> Floats:
    return np.asarray(np.array(vector) / np.linalg.norm(vector))


def _turned(axis: RotaryAxis, readings_deg: Floats, vectors: Floats, back: bool = False) -> Floats:
    """Vectors (N, 3) turned about the axis' direction, each by its own reading (N,)."""
    direction = _unit(axis.rotation_vector)
    angle = np.radians(axis.sense * (readings_deg - axis.zero_offset_deg))[:, None] * (-1 if back else 1)
    along = (vectors @ direction)[:, None] * direction
    across = vectors - along
    return np.asarray(along + np.cos(angle) * across + np.sin(angle) * np.cross(direction, vectors))


def _turned_about_line(axis: RotaryAxis, readings_deg: Floats, points: Floats, back: bool = False) -> Floats:
    origin = np.array(axis.joint_origin_mm)
    return np.asarray(origin + _turned(axis, readings_deg, points - origin, back))
