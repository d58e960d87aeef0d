"""What the commands of the command line do; each returns the exit status."""

from __future__ import annotations

from argparse import Namespace

from . import bench as benchmark
from . import job, output, planning, report, results
from .cl_file import read_csv
from .console import ProgressLine
from .info import info_lines
from .program_file import check_file
from .stages import Stages
from .verification import verify as verify_moves

GOOD, NOT_GOOD = 0, 1


def plan(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    spec = job.load(arguments.job)
    computed = planning.plan(spec, on_progress=progress, threads=arguments.threads)
    files = results.files(computed, Stages(progress, threads=arguments.threads))
    if arguments.proof:
        files |= results.proof(computed)
    progress.clear()
    print(report.text(computed.report), end="")
    _write(arguments.out, files)
    return GOOD if computed.report["verdict"]["good"] else NOT_GOOD


def info(arguments: Namespace, progress: ProgressLine) -> int:
    print(*info_lines(arguments.file), sep="\n")
    return GOOD


def verify(arguments: Namespace, progress: ProgressLine) -> int:
    spec = job.load(arguments.job)
    moves = read_csv(arguments.cl_file)
    found = verify_moves(spec, moves, Stages(progress, threads=arguments.threads))
    progress.clear()
    print(*found.lines, sep="\n")
    return GOOD if found.good else NOT_GOOD


def check(arguments: Namespace, progress: ProgressLine) -> int:
    found = check_file(
        arguments.program, arguments.machine, arguments.post, arguments.against, not arguments.joints
    )
    print(*found.lines, sep="\n")
    return GOOD if found.good else NOT_GOOD


def bench(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    runs = benchmark.runs(arguments.surfaces, arguments.methods, arguments.threads)
    rows = [benchmark.measure(run, progress) for run in runs]
    progress.clear()
    print(benchmark.table(rows))
    files: dict[str, bytes | str] = {"bench.json": benchmark.to_json(rows)}
    if arguments.csv:
        files[arguments.csv] = benchmark.to_csv(rows)
    _write(arguments.out, files)
    return GOOD


def _write(folder: str, files: dict[str, bytes | str]) -> None:
    print("\nWritten:")
    for path in output.write_together(folder, files):
        print(f"  {path}")
