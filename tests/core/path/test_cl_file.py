"""cl.csv: exact form, there and back, and errors that name the line."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path as FilePath

import numpy as np
import pytest

from freecad_mpm.core.base import InputError
from freecad_mpm.core.path import ToolPath, cl_file, to_apt
from freecad_mpm.core.positioning import Positions

DESIGN_HEADER = (
    "pass,index,kind,status,tip_x,tip_y,tip_z,axis_x,axis_y,axis_z,p_x,p_y,p_z,q_x,q_y,q_z,tilt_deg,spin_deg,"
    "clearance_lo_mm,clearance_hi_mm"
)


def unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


@pytest.fixture
def positions() -> Positions:
    """Two passes of 3 and 2 positions; the second position has no second contact."""
    random = np.random.default_rng(7)
    contacts = random.normal(size=(5, 2, 3))
    contacts[1, 1] = np.nan
    return Positions(
        tip=random.normal(size=(5, 3)) * 100,
        axis=unit(random.normal(size=(5, 3)) + [0, 0, 4]),
        contacts=contacts,
        normals=unit(random.normal(size=(5, 2, 3))),
        status=np.array(["two_contacts", "one_contact", "two_contacts", "bridged", "two_contacts"]),
        clearance=np.column_stack((np.full(5, -np.inf), random.normal(size=5))),
        tilt_deg=random.uniform(0, 45, 5),
        spin_deg=np.zeros(5),
        pass_index=np.array([0, 0, 0, 1, 1]),
        inserted=np.zeros(5, dtype=bool),
    )


@pytest.fixture
def path(positions: Positions) -> ToolPath:
    """Rapid, plunge, two cuts, retract; rapid, plunge, cut."""
    position = np.array([-1, 0, 1, 2, -1, -1, 3, 4])
    lift = np.where(position < 0, 50.0, 0.0)[:, None] * [0, 0, 1]
    nearest = np.array([0, 0, 1, 2, 2, 3, 3, 4])
    return ToolPath(
        kind=np.array(["rapid", "plunge", "cut", "cut", "retract", "rapid", "plunge", "cut"]),
        tip=positions.tip[nearest] + lift,
        axis=positions.axis[nearest],
        position=position,
        pass_index=positions.pass_index[nearest],
        clearance=np.zeros(8),
        blocked=np.zeros(8, dtype=bool),
        proven=np.ones(8, dtype=bool),
    )


def test_every_position_is_one_row_of_kind_cut(positions: Positions, path: ToolPath) -> None:
    lines = cl_file.to_csv(positions, path).splitlines()
    assert lines[0] == DESIGN_HEADER
    rows = [line.split(",") for line in lines[1:]]
    assert {len(row) for row in rows} == {20}
    assert [row[2] for row in rows] == [
        "rapid",
        "plunge",
        *["cut"] * 3,
        "retract",
        "rapid",
        "plunge",
        *["cut"] * 2,
    ]
    cuts = [row for row in rows if row[2] == "cut"]
    assert [(row[0], row[1]) for row in cuts] == [("0", "0"), ("0", "1"), ("0", "2"), ("1", "0"), ("1", "1")]
    assert [row[3] for row in cuts] == positions.status.tolist()
    others = [row for row in rows if row[2] != "cut"]
    assert all(row[1] == "-1" and not any(row[3:4] + row[10:]) for row in others)


def test_numbers_have_nine_decimals_and_missing_ones_are_empty(positions: Positions, path: ToolPath) -> None:
    positions = replace(positions, spin_deg=np.full(5, -1e-12))
    cuts = [line.split(",") for line in cl_file.to_csv(positions, path).splitlines() if ",cut," in line]
    assert cuts[1][13:16] == ["", "", ""]
    assert cuts[1][10] == f"{positions.contacts[1, 0, 0]:.9f}"
    assert {row[17] for row in cuts} == {"0.000000000"}, "minus zero"
    assert {row[18] for row in cuts} == {"-inf"}
    assert all(len(cell.partition(".")[2]) == 9 for cell in cuts[0][4:18])


def test_there_and_back(positions: Positions, path: ToolPath, tmp_path: FilePath) -> None:
    file = tmp_path / "cl.csv"
    file.write_text(cl_file.to_csv(positions, path))
    moves = cl_file.read_csv(file)
    cuts = moves.kind == "cut"
    assert moves.tip[cuts] == pytest.approx(positions.tip, abs=5.1e-10)
    assert moves.axis[cuts] == pytest.approx(positions.axis, abs=1e-8)
    assert moves.pass_index[cuts].tolist() == positions.pass_index.tolist()
    assert moves.line.tolist() == list(range(2, 12))


def test_other_peoples_files_need_only_tip_and_axis(tmp_path: FilePath) -> None:
    file = tmp_path / "theirs.csv"
    file.write_text("axis_z, axis_x,axis_y,tip_z,tip_y,tip_x,remark\r\n\r\n0.8, 0.6,0,3,2,1,hello\r\n")
    moves = cl_file.read_csv(file)
    assert (moves.tip.tolist(), moves.axis.tolist()) == ([[1, 2, 3]], [[0.6, 0, 0.8]])
    assert (moves.kind.tolist(), moves.pass_index.tolist(), moves.line.tolist()) == (["cut"], [0], [3])


POSE = "tip_x,tip_y,tip_z,axis_x,axis_y,axis_z"
BAD_FILES = [
    ("", r"must have a header line"),
    (POSE + "\n", r"must have a header line and at least one move"),
    (POSE.replace("tip_y,", "") + "\n0,0,0,0,1\n", r":1: the header must have the column tip_y"),
    (POSE + "\n0,0,0,0,0,1\n0,0,0,0,1\n", r":3: must have 6 columns like the header, got 5"),
    (POSE + "\n0,0,0,0,0,1\n0,0,zero,0,0,1\n", r":3: tip_z must be a finite number, got 'zero'"),
    (POSE + "\n0,0,nan,0,0,1\n", r":2: tip_z must be a finite number, got 'nan'"),
    (POSE + "\n0,0,0,0,0,1\n0,0,0,0,0,2\n", r":3: the axis must have length 1, got 2"),
    (POSE + ",kind\n0,0,0,0,0,1,mill\n", r":2: kind must be one of cut, .*, got 'mill'"),
    (POSE + ",pass\n0,0,0,0,0,1,x\n", r":2: pass must be a finite number, got 'x'"),
]


@pytest.mark.parametrize(("text", "message"), BAD_FILES)
def test_a_bad_file_is_named_with_its_line(tmp_path: FilePath, text: str, message: str) -> None:
    file = tmp_path / "bad.csv"
    file.write_text(text)
    with pytest.raises(InputError, match=rf"bad\.csv(: )?{message}"):
        cl_file.read_csv(file)


def test_binary_and_missing_files_are_refused(tmp_path: FilePath) -> None:
    (tmp_path / "bad.csv").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="must be a CSV text"):
        cl_file.read_csv(tmp_path / "bad.csv")
    with pytest.raises(InputError, match="cannot be read: No such file"):
        cl_file.read_csv(tmp_path / "nothing.csv")


def test_apt_holds_every_move_and_a_feed_wherever_it_changes(path: ToolPath) -> None:
    feeds = {"cut": 1000.0, "link": 1000.0, "plunge": 300.0, "retract": 300.0}
    lines = to_apt(path, "TEST", radius_mm=12.7, corner_radius_mm=6.0, feeds=feeds).splitlines()
    assert lines[0] == "PARTNO TEST" and lines[-1] == "FINI"
    assert "CUTTER/25.4000,6.0000" in lines
    goto = [[float(word) for word in line[5:].split(",")] for line in lines if line.startswith("GOTO/")]
    assert np.array(goto) == pytest.approx(np.hstack((path.tip, path.axis)), abs=1e-9)
    assert lines.count("RAPID") == 2
    words = [line for line in lines if line.startswith("FEDRAT")]
    assert words == [f"FEDRAT/{feed},MMPM" for feed in (300, 1000, 300, 1000)]
