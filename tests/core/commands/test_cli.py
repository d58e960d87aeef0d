"""The command line as a user runs it: results, exit statuses, and one line for every bad input."""

from __future__ import annotations

import errno
import os
import pty
import resource
import signal
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module
from pathlib import Path

import pytest
from command_line import LIMIT_S, ROOT, run, start

from freecad_mpm.core.commands import cli

# Processor time from Ctrl-C to the end of the process.
STOPPED_S = 2.0


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


@pytest.mark.parametrize("word", cli.COMMANDS)
def test_every_word_of_the_list_is_a_command(word: str) -> None:
    command = import_module(f"freecad_mpm.core.commands.{word}")
    assert str(command.__doc__).startswith(f"`{word}`: ")
    assert callable(command.arguments) and callable(command.run)


@pytest.mark.parametrize(("words", "status"), [("--help", 0), ("plan job.toml --out out", 2)])
def test_without_the_native_module_the_list_is_shown_and_a_command_says_what_to_do(
    words: str, status: int
) -> None:
    block = "import sys; sys.modules['freecad_mpm._core'] = None; sys.argv = ['freecad_mpm', *sys.argv[1:]]; "
    start = f"{block}from freecad_mpm.core.commands import main; sys.exit(main())"
    found = subprocess.run(
        [sys.executable, "-c", start, *words.split()], cwd=ROOT, capture_output=True, text=True
    )
    assert found.returncode == status
    assert ("build them with ./dev build" in found.stderr) == (status == 2)
    assert found.stderr.count("\n") == (1 if status else 0)
