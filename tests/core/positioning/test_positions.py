"""Positions as arrays: which of them a path may use, and which are neighbours."""

from __future__ import annotations

import numpy as np

from freecad_mpm.core.part import Frame
from freecad_mpm.core.positioning import Positions, positions_in_part

STATUS = np.array(["two_contacts", "undecided", "one_contact", "bridged", "off_part"])


def positions() -> Positions:
    count = len(STATUS)
    tip = np.column_stack((np.arange(5.0), np.zeros(5), np.ones(5)))
    tip[4] = np.nan
    return Positions(
        tip=tip,
        axis=np.tile([0.0, 0.0, 1.0], (count, 1)),
        contacts=np.zeros((count, 2, 3)),
        normals=np.tile([0.0, 0.0, 1.0], (count, 2, 1)),
        status=STATUS,
        clearance=np.zeros((count, 2)),
        tilt_deg=np.zeros(count),
        spin_deg=np.zeros(count),
        pass_index=np.array([0, 0, 0, 0, 0]),
        inserted=np.zeros(count, dtype=bool),
    )


def test_what_nobody_knows_or_has_no_pose_is_not_usable() -> None:
    assert positions().usable.tolist() == [True, False, True, True, False]


def test_neighbours_are_usable_and_of_one_pass() -> None:
    assert positions().neighbours.tolist() == [False, False, False, True, False]


def test_a_turned_frame_turns_points_and_directions() -> None:
    frame = Frame(np.array([10.0, 0.0, 0.0]), np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    turned = positions_in_part(positions(), frame)
    assert np.allclose(turned.tip[2], [11.0, 2.0, 0.0])  # set-up x, y, z are the part's y, z, x
    assert np.allclose(turned.axis, [1.0, 0.0, 0.0]) and np.allclose(turned.contacts, [10.0, 0.0, 0.0])
    assert turned.status is STATUS
