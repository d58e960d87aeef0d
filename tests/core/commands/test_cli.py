"""The command line as a user runs it: results, exit statuses, and one line for every bad input."""

from __future__ import annotations

import csv
import errno
import json
import os
import pty
import resource
import signal
from collections.abc import Callable
from pathlib import Path

import pytest
from command_line import LIMIT_S, run, start

RESULTS = {"cl.csv", "cl.apt", "program.I", "report.json", "report.txt", "machined.stl", "path.png"}
# Processor time from Ctrl-C to the end of the process.
STOPPED_S = 2.0


def test_plan_writes_all_results_and_says_where(job_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    status, text, error = run("plan", job_file, "--out", out)
    assert (status, error) == (0, "")
    assert {path.name for path in out.iterdir()} == RESULTS
    assert all(str(out / name) in text for name in RESULTS)
    assert "sampled: no proof" in text
    report = json.loads((out / "report.json").read_text())
    assert report["positions"]["count"] == 28 and report["verdict"]["good"] is True
    assert (out / "report.txt").read_text() in text


def test_a_plan_with_gouges_is_written_and_has_status_1(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("chord_mm = 2.0", "chord_mm = 1e-6"))
    status, text, error = run("plan", job_file, "--out", tmp_path / "out")
    assert (status, error) == (1, "")
    assert "NOT GOOD" in text and (tmp_path / "out" / "cl.csv").exists()


def test_threads_do_not_change_the_results(job_file: Path, tmp_path: Path) -> None:
    for threads in (1, 2):
        assert run("plan", job_file, "--out", tmp_path / str(threads), "--threads", threads)[0] == 0
    for name in sorted(RESULTS - {"report.json", "report.txt"}):  # these hold times
        assert (tmp_path / "1" / name).read_bytes() == (tmp_path / "2" / name).read_bytes(), name


def test_verify_agrees_with_plan_and_finds_a_spoilt_pose(job_file: Path, tmp_path: Path) -> None:
    assert run("plan", job_file, "--out", tmp_path)[0] == 0
    status, text, error = run("verify", job_file, tmp_path / "cl.csv")
    assert (status, error) == (0, "")
    lines = (tmp_path / "cl.csv").read_text().splitlines()
    number, line = next((i, line) for i, line in enumerate(lines) if ",cut," in line)
    cells = line.split(",")
    cells[6] = str(float(cells[6]) - 1.0)  # tip_z
    (tmp_path / "spoilt.csv").write_text("\n".join([*lines[:number], ",".join(cells), *lines[number + 1 :]]))
    status, text, error = run("verify", job_file, tmp_path / "spoilt.csv")
    assert (status, error) == (1, "")
    assert "NOT GOOD" in text and f"line {number + 1} " in text


def test_info_lists_the_faces(thesis_part: Callable[[str], Path]) -> None:
    status, text, error = run("info", thesis_part("saddle"))
    assert (status, error) == (0, "")
    assert "Face1" in text and "150.000" in text


def test_bench_prints_and_writes_rows(job_file: Path, tmp_path: Path) -> None:
    status, text, error = run("bench", "--surfaces", job_file, "--methods", "vcrf", "--out", tmp_path)
    assert (status, error) == (0, "")
    rows = json.loads((tmp_path / "bench.json").read_text())["rows"]
    wanted = {"method", "surface", "threads", "positions", "positions_per_second", "evaluations_per_position"}
    assert rows and all(wanted <= set(row) for row in rows)
    assert {(row["method"], row["surface"], row["positions"]) for row in rows} == {("vcrf", "job", 28)}
    assert rows[0]["threads"] == 1 and rows[0]["positions_per_second"] > 0
    assert rows[0]["evaluations_per_position"] > 1000
    assert "vcrf" in text
    assert 0.5 < rows[0]["two_contacts"] <= 1
    assert rows[0]["worst_gouge_mm"] >= rows[0]["deep_gouge_mm"]
    assert (tmp_path / "bench.png").read_bytes().startswith(b"\x89PNG")


def test_bench_writes_its_tables_into_pages_and_names_one_without_a_block(
    job_file: Path, tmp_path: Path
) -> None:
    page = tmp_path / "page.md"
    page.write_text("Before\n<!-- begin summary -->\nold\n<!-- end summary -->\nafter\n")
    arguments = ("--surfaces", job_file, "--methods", "exact", "--threads", "1", "--out", tmp_path)
    assert run("bench", *arguments, "--markdown", page)[0] == 0
    text = page.read_text()
    assert text.startswith("Before\n") and text.endswith("after\n") and "| `exact` |" in text
    page.write_text("nothing")
    status, _, error = run("bench", *arguments, "--markdown", page)
    assert status == 2 and "page.md: has none of the blocks" in error and page.read_text() == "nothing"


def test_spins_writes_the_spread_and_the_control(job_file: Path, tmp_path: Path) -> None:
    wanted = 'name = "exact"\ncontact_spacing_mm = 6\nspacing_measure = "direct"'
    job_file.write_text(job_file.read_text().replace('name = "vcrf"', wanted))
    status, text, error = run(
        "spins", job_file, "--out", tmp_path, "--at", "40,60", "110,90", "--step-deg", 30
    )
    assert (status, error) == (0, "")
    assert "Contacts 6 mm apart from contact to contact: within 1% at 28 of 28 positions" in text
    rows = list(csv.DictReader((tmp_path / "spins.csv").read_text().splitlines()))
    assert len(rows) == 24 and {row["status"] for row in rows} == {"two_contacts"}
    assert (tmp_path / "spins.png").exists() and (tmp_path / "spacing.png").exists()


def test_spins_beside_the_part_are_told_and_nothing_is_written(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("vcrf", "exact"))
    status, text, error = run(
        "spins", job_file, "--out", tmp_path / "out", "--at", "75,75", "400,20", "--step-deg", 90
    )
    assert (status, text) == (2, "") and not (tmp_path / "out").exists()
    assert error == "(400, 20): lies beside the part: no spin of the tool touches it there\n"


def test_a_plan_that_leaves_cuts_out_is_not_good(job_file: Path, tmp_path: Path) -> None:
    job_file.write_text(job_file.read_text().replace("allow_gaps = true", ""))
    status, text, error = run("plan", job_file, "--out", tmp_path / "out")
    assert (status, error) == (1, "")
    assert text.startswith("Verdict: NOT GOOD: 10 moves between neighbours of a pass are not cut (")
    worst = json.loads((tmp_path / "out" / "report.json").read_text())["cut"]["worst_gouge"]
    assert f"Worst gouge: {worst['deviation_mm']:+.4f} mm at" in text
    assert (
        f"(cut, pass {worst['pass_index']}, position {worst['position']}); {worst['depth_mm']:.4f} mm inside the tool"
        in text
    )
    # Between positions 25 mm apart the chord cuts in; the tool's own depth is what the chord tolerance is about.
    assert 0.02 < worst["depth_mm"] <= -worst["deviation_mm"] + 1e-4 and worst["depth_mm"] < 2.0


def test_bench_writes_the_rows_as_csv_too(job_file: Path, tmp_path: Path) -> None:
    arguments = ("--surfaces", job_file, "--methods", "dtm", "--threads", "1", "--out", tmp_path)
    assert run("bench", *arguments, "--csv", "bench.csv")[0] == 0
    row = json.loads((tmp_path / "bench.json").read_text())["rows"][0]
    head, line = list(csv.reader((tmp_path / "bench.csv").read_text().splitlines()))
    assert head == list(row) and dict(zip(head, line))["method"] == "dtm"
    assert row["seeds_per_position"] >= 1 and row["newton_steps_per_position"] > 1


# What replaces what in a good job file, and what the one line must hold.
BAD_JOBS = [
    ('file = "', 'file = "/nowhere', "/nowhere"),
    ('file = "', 'file = "job.toml" # "', "job.toml"),
    ("[tool]", 'faces = ["Face7"]\n[tool]', "[part] faces: 'Face7': no such face"),
    ("[tool]", 'faces = ["Edge1"]\n[tool]', "[part] faces: 'Edge1': no such face"),
    ("[tool]", 'check_faces = ["Face1"]\n[tool]', "[part] check_faces: must not name a face to machine"),
    (
        "major_radius_mm = 6.7",
        "major_radius_mm = -6.7",
        "[tool] major_radius_mm: must be zero or a positive number",
    ),
    (
        "minor_radius_mm = 6.0",
        "minor_radius_mm = nan",
        "[tool] minor_radius_mm: must be zero or a positive number",
    ),
    ("6.7\nminor_radius_mm = 6.0", "0\nminor_radius_mm = 0", "[tool] major_radius_mm: must not be 0"),
    ("side_step_mm = 50.0", "side_step_mm = 0", "[footprint] side_step_mm: must be a positive number"),
    ("side_step_mm = 50.0", "side_step_mm = -1", "[footprint] side_step_mm: must be a positive number"),
    ("side_step_mm = 50.0", "side_step_mm = nan", "[footprint] side_step_mm: must be a positive number"),
    ("side_step_mm = 50.0", "side_step_mm = 0.0001", "10000000 positions"),
    ("side_step_mm = 50.0", "side_step_mm = 50\nmargin_mm = -75.1", "[footprint] margin_mm"),
    ("[tool]", "[setup]\nz = [0, 0, 0]\n[tool]", "[setup] z: must be a direction that is not of length zero"),
    ("[tool]", "[setup]\nx = [0, 0, 1]\n[tool]", "[setup] x: must not be parallel to z"),
    ('name = "vcrf"', 'name = "vrcf"', "[method] name: unknown method 'vrcf'; did you mean vcrf?"),
    ("[tool]", '[machine]\nname = "dmu80"\n[tool]', "[machine] name: machine 'dmu80': unknown"),
    ("[tool]", '[post]\nname = "dmu80"\n[tool]', "[post] name: post 'dmu80': unknown"),
    ("[tool]", '[post]\nprogram_name = "a b"\n[tool]', "[post] program_name: must be"),
    ('name = "vcrf"', 'name = "vcrf"\ncontact_spacing_mm = 5', "contact_spacing_mm: must be 0 for vcrf"),
    ("side_step_mm", "sidestep_mm", "[footprint] sidestep_mm: unknown key; did you mean side_step_mm?"),
    ("[footprint]", "[foot]", "[foot]: unknown table"),
    ("[tool]", "[tool", "is not valid TOML"),
]


@pytest.mark.parametrize(("right", "wrong", "message"), BAD_JOBS)
def test_bad_jobs_get_one_line_and_leave_the_folder_alone(
    job_file: Path, tmp_path: Path, right: str, wrong: str, message: str
) -> None:
    text = job_file.read_text()
    assert right in text
    job_file.write_text(text.replace(right, wrong, 1))
    out = tmp_path / "out"
    out.mkdir()
    (out / "cl.csv").write_text("old")
    status, printed, error = run("plan", job_file, "--out", out)
    assert (status, printed) == (2, "")
    assert error.endswith("\n") and error.count("\n") == 1, error
    assert message in error and "job.toml" in error
    assert {path.name: path.read_text() for path in out.iterdir()} == {"cl.csv": "old"}


def spoil(path: Path, content: bytes) -> Path:
    path.write_bytes(content)
    return path


BAD_COMMANDS: dict[str, Callable[[Path, Path], tuple[list[object], str]]] = {
    "no command": lambda job, folder: ([], "COMMAND"),
    "unknown command": lambda job, folder: (["plann", job], "'plann'"),
    "no job": lambda job, folder: (["plan", "--out", folder], "JOB.toml"),
    "no out": lambda job, folder: (["plan", job], "--out"),
    "missing job": lambda job, folder: (
        ["plan", folder / "no.toml", "--out", folder],
        "no.toml: cannot be read",
    ),
    "job is a folder": lambda job, folder: (["plan", folder, "--out", folder], f"{folder}: cannot be read"),
    "job is binary": lambda job, folder: (
        ["plan", spoil(folder / "b.toml", b"\xff\x00"), "--out", folder],
        "b.toml: must be a TOML text",
    ),
    "out is a file": lambda job, folder: (["plan", job, "--out", job], "job.toml: must be a folder"),
    "threads": lambda job, folder: (["plan", job, "--out", folder, "--threads", "-1"], "--threads"),
    "info of nothing": lambda job, folder: (["info", folder / "no.step"], "no.step"),
    "info of a folder": lambda job, folder: (["info", folder], str(folder)),
    "info of garbage": lambda job, folder: (["info", spoil(folder / "bad.step", b"garbage")], "bad.step"),
    "info of an empty file": lambda job, folder: (["info", spoil(folder / "bad.brep", b"")], "bad.brep"),
    "spins of a method that cannot": lambda job, folder: (
        ["spins", job, "--out", folder],
        "vcrf cannot spin",
    ),
    "spins nowhere": lambda job, folder: (["spins", job, "--out", folder, "--at", "4"], "must be X,Y"),
    "spins by nothing": lambda job, folder: (
        ["spins", job, "--out", folder, "--step-deg", "0"],
        "must be a positive number",
    ),
    "bench into nothing": lambda job, folder: (
        ["bench", "--out", folder, "--markdown", folder / "no.md"],
        "no.md: cannot be read",
    ),
    "verify nothing": lambda job, folder: (["verify", job, folder / "no.csv"], "no.csv: cannot be read"),
    "verify garbage": lambda job, folder: (["verify", job, job], "job.toml:"),
    "bench of nothing": lambda job, folder: (
        ["bench", "--surfaces", "no", "--out", folder],
        "--surfaces: 'no'",
    ),
    "bench by nothing": lambda job, folder: (
        ["bench", "--surfaces", job, "--methods", "vrcf", "--out", folder],
        "did you mean vcrf?",
    ),
}


@pytest.mark.parametrize("case", BAD_COMMANDS)
def test_bad_commands_get_one_line(job_file: Path, tmp_path: Path, case: str) -> None:
    arguments, message = BAD_COMMANDS[case](job_file, tmp_path)
    before = sorted(tmp_path.rglob("*"))
    status, printed, error = run(*arguments)
    assert (status, printed) == (2, "")
    assert error.endswith("\n") and error.count("\n") == 1, error
    assert message in error
    assert sorted(tmp_path.rglob("*")) == before


def test_unreadable_files_are_named(job_file: Path, tmp_path: Path) -> None:
    """A link to itself: root reads whatever else is there."""
    job_file.unlink()
    job_file.symlink_to(job_file)
    assert (
        run("plan", job_file, "--out", tmp_path)[2]
        == f"{job_file}: cannot be read: {os.strerror(errno.ELOOP)}\n"
    )


def test_ctrl_c_stops_soon_and_writes_nothing(job_file: Path, tmp_path: Path) -> None:
    """On a terminal, whose progress line tells when the positions are being computed."""
    fine = job_file.read_text().replace("side_step_mm = 50.0", "side_step_mm = 0.5")
    job_file.write_text(fine.replace("forward_step_mm = 25.0", "forward_step_mm = 0.5"))
    terminal, stderr = pty.openpty()
    process = start("plan", job_file, "--out", tmp_path / "out", stderr=stderr)
    os.close(stderr)
    shown = ""
    while "positions" not in shown:
        shown += os.read(terminal, 1024).decode()
    children = children_s()
    worked = worked_s(process.pid)
    process.send_signal(signal.SIGINT)
    try:
        assert process.wait(LIMIT_S) == 130
    finally:
        process.kill()
    assert children_s() - children - worked < STOPPED_S
    assert rest_of(terminal).endswith("stopped: nothing was written\r\n")
    assert not (tmp_path / "out").exists()


def rest_of(terminal: int) -> str:
    """All that is still to read from a terminal on which nobody writes any more; the read after it fails."""
    text = b""
    try:
        while more := os.read(terminal, 1024):
            text += more
    except OSError:
        pass
    return text.decode()


def worked_s(process: int) -> float:
    """Processor time of a process that runs (proc(5): fields 14 and 15, the second being a name in brackets)."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def children_s() -> float:
    """Processor time of all child processes that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def test_a_reader_that_goes_away_is_no_error(thesis_part: Callable[[str], Path]) -> None:
    process = start("info", thesis_part("saddle"))
    assert process.stdout
    process.stdout.close()
    assert process.stderr
    assert process.stderr.read() == ""
    assert process.wait(LIMIT_S) == 141


def test_cut_measures_a_plan_and_its_files(job_file: Path, tmp_path: Path) -> None:
    assert run("plan", job_file, "--out", tmp_path / "plan")[0] == 0
    out = tmp_path / "cut"
    for source in ("cl.csv", "program.I"):
        status, text, error = run(
            *("cut", job_file, tmp_path / "plan" / source, "--out", out, "--resolution-mm", 6),
            *("--section", "y=27", "--probe-radius-mm", 2, "--mesh", "left.obj"),
        )
        assert (status, error) == (0, "")
        assert "Worst gouge: " in text and "Section y27:" in text and "by probe" in text
        names = {"cut.json", "cut.txt", "deviation.png", "section_y27.csv", "section_y27.png", "left.obj"}
        assert {path.name for path in out.iterdir()} == names
        facts = json.loads((out / "cut.json").read_text())
        assert facts["worst_gouge"]["move"] >= 0 and facts["sections"]["y27"]["max_mm"] > 1
        rows = list(csv.DictReader((out / "section_y27.csv").read_text().splitlines()))
        assert {float(row["y"]) for row in rows} == {27.0}


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--resolution-mm", "0"], "--resolution-mm: must be a positive number"),
        (["--section", "w=3"], "--section: must be x=MM, y=MM, z=MM, line=X,Y:X,Y or point="),
        (["--section", "x=75", "--section", "z=300"], "--section z300: the plane does not meet the faces"),
        (["--mesh", "a.3mf"], "a.3mf: a mesh file must end in one of"),
        (["--resolution-mm", "0.0001"], "mm would fit, or a small box"),
    ],
)
def test_cut_says_what_is_wrong(words: list[str], said: str, job_file: Path, tmp_path: Path) -> None:
    status, out, error = run("cut", job_file, "--out", tmp_path / "out", *words)
    assert (status, out) == (2, "") and said in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_picture_draws_chosen_positions(job_file: Path, tmp_path: Path) -> None:
    out = tmp_path / "pictures"
    status, text, error = run("picture", job_file, "--position", 1, 12, "--out", out)
    assert (status, error) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == ["position_000001.png", "position_000012.png"]
    assert all((out / name).read_bytes().startswith(b"\x89PNG") and name in text for name in os.listdir(out))


@pytest.mark.parametrize(
    ("number", "message"),
    [
        (0, "argument --position: must be a whole number from 1, got '0'"),
        (29, "position 29: must be from 1 to 28"),
    ],
)
def test_picture_of_a_position_that_is_not_there(
    job_file: Path, tmp_path: Path, number: int, message: str
) -> None:
    status, text, error = run("picture", job_file, "--position", number, "--out", tmp_path / "pictures")
    assert (status, text) == (2, "") and message in error and error.count("\n") == 1
    assert not (tmp_path / "pictures").exists()
