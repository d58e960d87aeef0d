"""Following a CL list with the poses that a program really drives to."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

Point = Sequence[float]
Errors = tuple[float, float]  # mm of the tip, degrees of the axis

# A pose counts as met within the tolerances; further blocks on the way to it may then, rounded, be a little farther off.
LINGERING = 1.5


class Walk:
    """Takes the poses of a program one by one and says which of them do not belong to the list.

    A pose belongs when it is the one that the list has next, or lies on the straight line and the great circle to it.
    Plain floats: a list of 100,000 poses is walked in a second."""

    def __init__(
        self, tip: Any, axis: Any, tip_tolerance_mm: float, axis_tolerance_deg: float, may_rise: bool = False
    ) -> None:
        """may_rise: between two poses the program may go anywhere above both at rapid rate."""
        self._tip = [tuple(p) for p in tip]
        self._axis = [tuple(d) for d in axis]
        self._tip_tolerance_mm, self._axis_tolerance_deg = tip_tolerance_mm, axis_tolerance_deg
        self._allowed_deg = axis_tolerance_deg  # of the step that is looked at
        self._may_rise = may_rise
        self._away = True  # not on the list yet, or for another tool
        self.next = 0  # pose of the list that is expected
        self._worst: Errors = (0.0, 0.0)
        self._last: Errors = (
            0.0,
            0.0,
        )  # of the last pose of the list: a later block may still meet it better

    def leave(self) -> None:
        """The program leaves the list, for another tool: at rapid rate it may go anywhere until it meets the next
        pose."""
        self._away = True

    @property
    def tip_error_mm(self) -> float:
        """Largest over the program's poses that belong."""
        return max(self._worst[0], self._last[0])

    @property
    def axis_error_deg(self) -> float:
        """Largest over the program's poses that belong."""
        return max(self._worst[1], self._last[1])

    def step(self, tip: Point, axis: Point, rapid: bool, axis_slack_deg: float = 0.0) -> str:
        """The program's next pose: what is wrong with it, or an empty string. axis_slack_deg: by how much more than the
        tolerance its axis may be off."""
        self._allowed_deg = self._axis_tolerance_deg + axis_slack_deg
        if self._meets(self.next, tip, axis):
            self._go_to(self.next, tip, axis)
        elif self._away:
            return "" if rapid else f"a feed move before pose {self.next} of the CL list"
        elif self._meets(self.next - 1, tip, axis, LINGERING):
            self._last = min(self._last, self._errors(self.next - 1, tip, axis), key=self._in_tolerances)
        elif self.next == len(self._tip):
            return "a move after the last pose of the CL list"
        elif not self._on_the_way(tip, axis, rapid) and not (rapid and self._above(tip)):
            return self._lost(tip, axis)
        return ""

    def _errors(self, pose: int, tip: Point, axis: Point) -> Errors:
        return math.dist(tip, self._tip[pose]), angle_deg(axis, self._axis[pose])

    def _in_tolerances(self, errors: Errors) -> float:
        """The errors as a multiple of what is allowed; not a number when the tip is not known."""
        in_tip, in_axis = errors[0] / self._tip_tolerance_mm, errors[1] / self._allowed_deg
        return in_tip if math.isnan(in_tip) else max(in_tip, in_axis)

    def _meets(self, pose: int, tip: Point, axis: Point, tolerances: float = 1.0) -> bool:
        return pose < len(self._tip) and self._in_tolerances(self._errors(pose, tip, axis)) <= tolerances

    def _go_to(self, pose: int, tip: Point, axis: Point) -> None:
        self._note(self._last)
        self._last = self._errors(pose, tip, axis)
        self.next, self._away = pose + 1, False

    def _note(self, errors: Errors) -> None:
        self._worst = max(self._worst[0], errors[0]), max(self._worst[1], errors[1])

    def _on_the_way(self, tip: Point, axis: Point, rapid: bool) -> bool:
        """Rapids may turn before or after they travel; feed moves do both evenly."""
        a, b = self.next - 1, self.next
        way, turn = math.dist(self._tip[a], self._tip[b]), angle_deg(self._axis[a], self._axis[b])
        travelled, off_line = _along_line(self._tip[a], self._tip[b], tip)
        turned, off_circle = _along_circle(self._axis[a], self._axis[b], axis)
        if not self._in_tolerances((off_line, off_circle)) <= 1.0:
            return False
        # turned / turn = travelled / way, as far as the two tolerances let them be told apart
        uneven = abs(travelled * turn - turned * way)
        if not rapid and uneven > self._allowed_deg * way + self._tip_tolerance_mm * turn:
            return False
        self._note((off_line, off_circle))
        return True

    def _above(self, tip: Point) -> bool:
        highest = max(self._tip[self.next - 1][2], self._tip[self.next][2])
        return self._may_rise and tip[2] >= highest - self._tip_tolerance_mm

    def _lost(self, tip: Point, axis: Point) -> str:
        missed = self.next
        if self._meets(
            missed + 1, tip, axis
        ):  # go on from there, so that one bad block is not held against all
            self._go_to(missed + 1, tip, axis)
            return f"pose {missed} of the CL list was not met before this one"
        off_tip, off_axis = self._errors(missed, tip, axis)
        return (
            f"is not pose {missed} of the CL list nor on the way to it: "
            f"tip off by {off_tip:.4f} mm, axis by {off_axis:.4f} degrees"
        )


def angle_deg(a: Point, b: Point) -> float:
    """Angle between two unit vectors, accurate for small ones."""
    return math.degrees(math.atan2(math.hypot(*_cross(a, b)), _dot(a, b)))


def _along_line(a: Point, b: Point, p: Point) -> tuple[float, float]:
    """Distance from a towards b of the place nearest to p, and the distance of p from it."""
    way = [q - r for q, r in zip(b, a)]
    length = math.hypot(*way)
    if length == 0:
        return 0.0, math.dist(a, p)
    along = min(max(_dot([q - r for q, r in zip(p, a)], way) / length, 0.0), length)
    return along, math.dist([q + along / length * w for q, w in zip(a, way)], p)


def _along_circle(a: Point, b: Point, d: Point) -> tuple[float, float]:
    """Degrees turned from a towards b where d is, and by how many d is off that great circle."""
    turn, from_a, from_b = angle_deg(a, b), angle_deg(a, d), angle_deg(d, b)
    normal = _cross(a, b)
    length = math.hypot(*normal)
    if length == 0 or from_a > turn or from_b > turn:  # no circle, or beyond one of its ends
        return (0.0, from_a) if from_a <= from_b else (turn, from_b)
    return from_a, math.degrees(abs(math.asin(min(1.0, abs(_dot(normal, d)) / length))))


def _dot(a: Point, b: Point) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Point, b: Point) -> tuple[float, float, float]:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]
