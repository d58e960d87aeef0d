"""Part files → face arrays, and what a bad file gets."""

from __future__ import annotations

import runpy

import numpy as np
import pytest
from part_samples import DATA, EXAMPLES, shared

from freecad_mpm import _core, _occt
from freecad_mpm.core.base import InputError
from freecad_mpm.core.part import FaceArrays, info_lines
from freecad_mpm.core.part.bezier_text import ROW
from freecad_mpm.core.part.faces import to_core
from freecad_mpm.core.part.file import read_brep_string, read_part

MAKE_EXAMPLES = runpy.run_path(str(EXAMPLES / "make_examples.py"), run_name="make_examples")

# One flat patch: 16 vertices on a grid of 1 mm.
FLAT_PATCH = "1\n" + ",".join(str(i) for i in range(1, 17)) + "\n16\n"
FLAT_PATCH += "".join(f"{i // ROW},{i % ROW},0\n" for i in range(16))


def write(folder, name, text):
    path = folder / name
    path.write_text(text)
    return path


@pytest.mark.parametrize("name", ["convex", "concave", "saddle"])
def test_thesis_examples_hold_the_table(name):
    (face,) = read_part(EXAMPLES / f"{name}.step")
    expected = MAKE_EXAMPLES["thesis_face"](name)
    np.testing.assert_array_equal(face.poles, expected["poles"])
    np.testing.assert_array_equal(face.knots_u, expected["knots_u"])
    assert (face.degree_u, face.degree_v, face.weights, face.trimmed) == (3, 3, None, False)


def test_thesis_table_is_read_with_i_along_x():
    poles = MAKE_EXAMPLES["thesis_face"]("saddle")["poles"]
    np.testing.assert_array_equal(poles[0, 1], [0, 50, 65])  # P01
    np.testing.assert_array_equal(poles[2, 0], [100, 0, 100])  # P20


def test_bonnet_die_has_free_form_faces_with_a_hole_and_plain_neighbours():
    faces = read_part(EXAMPLES / "bonnet_die.step")
    assert [face.name for face in faces] == [f"Face{i}" for i in range(1, 21)]
    crown = [face for face in faces if face.kind == "bspline"]
    assert [face.name for face in crown] == ["Face14", "Face15", "Face16", "Face17"]
    assert all(face.degree_u == face.degree_v == 3 and face.trimmed for face in crown)
    assert [len(face.trim_loops) for face in crown] == [1, 1, 1, 2]
    assert {face.kind for face in faces} == {"bspline", "plane", "cylinder"}


def test_brep_text_carries_placement_and_trim():
    text = (DATA / "bored_plate.brep").read_text()
    faces = read_brep_string(text)
    assert [face.name for face in faces] == [face.name for face in read_part(DATA / "bored_plate.brep")]
    assert sorted(face.kind for face in faces) == ["cylinder"] + ["plane"] * 6
    lo, hi = _core.SurfaceModel([to_core(face) for face in faces]).machined_bounds()
    np.testing.assert_allclose(lo, [70, 50, 20], atol=1e-9)  # turned by 90° and moved
    np.testing.assert_allclose(hi, [100, 90, 30], atol=1e-9)
    assert sorted(len(face.trim_loops) for face in faces) == [0, 0, 0, 0, 0, 2, 2]


def test_chord_tolerance_sets_the_number_of_sides():
    fine, coarse = (read_part(DATA / "bored_plate.brep", chord_mm=chord) for chord in (0.001, 0.1))
    sides = [sum(len(loop) for face in faces for loop in face.trim_loops) for faces in (fine, coarse)]
    assert sides[0] > 5 * sides[1]


def test_bezier_text(tmp_path):
    (face,) = read_part(write(tmp_path, "flat.txt", FLAT_PATCH.replace(",", " ")))
    np.testing.assert_array_equal(face.poles[2, 3], [2, 3, 0])
    assert (face.name, face.kind, face.degree_u, face.degree_v) == ("Face1", "bezier", 3, 3)


@pytest.mark.parametrize(
    "change, message",
    [
        (lambda text: "", "line 1: the file ends where 1 number of patches should follow"),
        (lambda text: text.replace("1\n", "0\n", 1), "line 1: the number of patches must be 1 or more"),
        (lambda text: text.replace("1\n", "x\n", 1), "line 1: must have 1 number of patches, got 'x'"),
        (lambda text: text.replace("1,2,3", "1,2", 1), "line 2: must have 16 vertex numbers"),
        (lambda text: text.replace("1,2,3", "99,2,3", 1), "patch 1: vertex numbers must be 1 to 16, got 99"),
        (lambda text: text.replace("1,2,3", "0,2,3", 1), "patch 1: vertex numbers must be 1 to 16, got 0"),
        (lambda text: text.replace("0,1,0", "0,1", 1), "line 5: must have 3 coordinates x,y,z, got '0,1'"),
        (lambda text: text.replace("0,1,0", "0,nan,0", 1), "coordinates must be finite numbers"),
        (lambda text: text[: -len("3,3,0\n")], "the file ends where 3 coordinates x,y,z should follow"),
    ],
)
def test_bad_bezier_text_names_file_and_line(tmp_path, change, message):
    path = write(tmp_path, "bad.txt", change(FLAT_PATCH))
    with pytest.raises(InputError) as error:
        read_part(path)
    assert str(error.value).startswith(f"{path}: ")
    assert message in str(error.value)


def test_binary_file_as_text_is_refused(tmp_path):
    path = tmp_path / "binary.txt"
    path.write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(InputError, match="cannot be read: it is not text"):
        read_part(path)


def test_bad_part_files_get_one_line_each(tmp_path):
    cases = {
        tmp_path / "missing.step": "there is no such file",
        tmp_path: "the ending of a part file must be one of .step",
        write(tmp_path, "part.stl", "solid"): "the ending of a part file must be one of .step",
        write(tmp_path, "empty.iges", ""): "is empty",
        write(tmp_path, "prose.step", "Not a part."): "is not a STEP, IGES or BREP file",
        write(tmp_path, "cut.step", (EXAMPLES / "saddle.step").read_text()[:2000]): "cannot be parsed",
    }
    for path, message in cases.items():
        with pytest.raises(InputError) as error:
            read_part(path)
        assert str(error.value).startswith(f"{path}: ")
        assert message in str(error.value)
        assert "\n" not in str(error.value)


def test_folder_with_a_part_ending_is_refused(tmp_path):
    (tmp_path / "folder.step").mkdir()
    with pytest.raises(InputError, match="is not a file"):
        read_part(tmp_path / "folder.step")


def test_brep_without_faces_is_refused():
    with pytest.raises(InputError, match="BREP text: does not start like"):
        read_brep_string("")


def test_bad_chord_is_refused():
    with pytest.raises(InputError, match="chord_mm must be positive"):
        read_part(EXAMPLES / "saddle.step", chord_mm=0.0)


def test_to_core_names_the_face():
    face = FaceArrays("Face7", "bspline", 1, 1, np.r_[0, 0, 1, 1.0], np.r_[0, 0, 1.0], np.zeros((2, 2, 3)))
    with pytest.raises(InputError, match="^Face7: knots_v"):
        to_core(face)


def test_to_core_keeps_name_and_role():
    (face,) = read_part(EXAMPLES / "saddle.step")
    assert (to_core(face, check=True).name, to_core(face, check=True).check) == ("Face1", True)
    assert not to_core(face).check


def test_info_lists_faces_with_tight_boxes():
    heading, line = info_lines(EXAMPLES / "saddle.step")
    assert heading.split()[:3] == ["face", "kind", "degree"]
    assert line.split()[:6] == ["Face1", "bspline", "3x3", "4x4", "no", "0"]
    assert "0.000 .. 150.000  0.000 .. 150.000  75.143 .. 97.521" in line


def test_info_of_the_bonnet_die_respects_the_trim():
    lines = info_lines(EXAMPLES / "bonnet_die.step")
    assert len(lines) == 21
    assert (
        "-90.000 .. 0.000" in lines[14] and "-65.000 .. 0.000" in lines[14]
    )  # the skin itself reaches 15 mm beyond


def test_step_written_twice_is_the_same_bytes(tmp_path):
    for name in ("one.step", "two.step"):
        _occt.write_step(str(tmp_path / name), [MAKE_EXAMPLES["thesis_face"]("saddle")], "saddle")
    assert (tmp_path / "one.step").read_bytes() == (tmp_path / "two.step").read_bytes()


def test_several_faces_are_written_in_order(tmp_path):
    faces = [MAKE_EXAMPLES["thesis_face"](name) for name in ("convex", "saddle")]
    _occt.write_step(str(tmp_path / "two.step"), faces)
    read = read_part(tmp_path / "two.step")
    for face, expected in zip(read, faces, strict=True):
        np.testing.assert_array_equal(face.poles, expected["poles"])


@pytest.mark.parametrize("name, count", [("nacelle.stp", 6), ("hammer.iges", 45), ("teapot.txt", 32)])
def test_parts_that_nobody_here_made(name, count):
    faces = read_part(shared(name))
    assert len(faces) == count
    assert all(to_core(face).name == face.name for face in faces)


def test_large_part_keeps_its_size():
    poles = np.concatenate([face.poles.reshape(-1, 3) for face in read_part(shared("nacelle.stp"))])
    assert poles[:, 0].max() == pytest.approx(2564.0)
