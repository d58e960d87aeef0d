"""What the commands of the command line do; each returns the exit status."""

from __future__ import annotations

from argparse import Namespace
from dataclasses import replace
from pathlib import Path as FilePath

from . import bench as benchmark
from . import (
    bench_degrees,
    bench_picture,
    bench_scaling,
    bench_summary,
    cut_command,
    cutting,
    job,
    markers,
    output,
    planning,
    playback_picture,
    published,
    report,
    results,
    spacing,
    spins,
    spins_picture,
)
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
    resolution = cutting.default_resolution_mm(computed.scene)
    cut = cutting.cut(
        computed.scene, computed.path, resolution, on_progress=progress, threads=arguments.threads
    )
    computed = replace(computed, report=report.with_cut(computed, cut))
    files = results.files(computed, cut, Stages(progress, threads=arguments.threads))
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


def cut(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    good, text, files = cut_command.run(
        arguments.job,
        arguments.program,
        resolution_mm=arguments.resolution_mm,
        sections=arguments.section or (),
        probe_radius_mm=arguments.probe_radius_mm,
        box=arguments.box,
        mesh=arguments.mesh,
        machine=arguments.machine,
        post=arguments.post,
        threads=arguments.threads,
        on_progress=progress,
        say=progress.say,
    )
    progress.clear()
    print(text, end="")
    _write(arguments.out, files)
    return GOOD if good else NOT_GOOD


def picture(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    spec = job.load(arguments.job)
    computed = planning.plan(spec, on_progress=progress, threads=arguments.threads)
    stages = Stages(progress, threads=arguments.threads)
    files = stages.run("pictures", playback_picture.of_plan, computed, arguments.position)
    progress.clear()
    _write(arguments.out, files)
    return GOOD


def bench(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    if arguments.published:
        return _bench_published(arguments, progress)
    pages = {name: markers.read(name) for name in arguments.markdown}
    blocks, files = (_scaling if arguments.scaling else _comparison)(arguments, progress)
    rewritten = {name: markers.replaced(text, blocks, name) for name, text in pages.items()}
    _write(arguments.out, files)
    for name, text in rewritten.items():
        output.write_atomically(name, text)
        print(f"  {name}")
    return GOOD


Files = dict[str, bytes | str]


def _comparison(arguments: Namespace, progress: ProgressLine) -> tuple[dict[str, str], Files]:
    runs = benchmark.runs(arguments.surfaces, arguments.methods, arguments.threads)
    rows = [benchmark.measure(run, progress) for run in runs]
    searches = [] if arguments.surfaces else bench_degrees.measure(runs, progress)
    tables = bench_summary.blocks(rows, searches)
    progress.clear()
    print(benchmark.table(rows))
    for claim, source, ours in tables["claims"].rows:
        print(f"\n{claim} ({source}):\n  {ours}")
    files: Files = {
        "bench.json": benchmark.to_json(rows, {"searches": searches}),
        "bench.png": bench_picture.draw(rows),
    }
    if arguments.csv:
        files[arguments.csv] = benchmark.to_csv(rows)
    return {name: table.markdown() for name, table in tables.items()}, files


def _scaling(arguments: Namespace, progress: ProgressLine) -> tuple[dict[str, str], Files]:
    rows = bench_scaling.run(progress)
    table = bench_scaling.table(rows).markdown()
    progress.clear()
    print(table)
    files: Files = {"scaling.json": benchmark.to_json(rows)}
    if arguments.csv:
        files[arguments.csv] = benchmark.to_csv(rows)
    return {"scaling": table}, files


def spins_of(arguments: Namespace, progress: ProgressLine) -> int:
    output.check_folder(arguments.out)
    spec = job.load(arguments.job)
    stages = Stages(progress, threads=arguments.threads)
    scene = planning.prepare(spec, None, stages)
    points = spins.chosen_points(spec, scene, arguments.at, stages)
    found = spins.spread(spec, scene, points, spins.circle(arguments.step_deg), arguments.scallop_mm, stages)
    name = f"{FilePath(spec.part.file).name}, {spec.method.name}"
    along = spacing.feed(spec.footprint.direction_deg)
    files: dict[str, bytes | str] = {
        "spins.csv": spins.to_csv(found),
        "spins.png": spins_picture.draw_spread(found, along, f"{name}: all spins over {len(points)} points"),
    }
    if spec.method.contact_spacing_mm:
        plain = replace(spec, method=replace(spec.method, contact_spacing_mm=0.0))
        before, after = (planning.plan(one, None, progress, None, arguments.threads) for one in (plain, spec))
        wanted = f"{spec.method.contact_spacing_mm:g} mm {spacing.MEASURES[spec.method.spacing_measure]}"
        files["spacing.png"] = spins_picture.draw_control(before, after, f"{name}: contacts {wanted}")
        progress.clear()
        print(spacing.sentence(after.report["contact_spacing"]))
    progress.clear()
    print(*spins.summary(found), sep="\n")
    _write(arguments.out, files)
    return GOOD


def _bench_published(arguments: Namespace, progress: ProgressLine) -> int:
    measured = []
    for one in published.measure_all(on_progress=progress, threads=arguments.threads):
        measured.append(one)
        progress.clear()
        print(published.table([one.row]).splitlines()[-1], flush=True)
    rows = [one.row for one in measured]
    print("\n" + published.table(rows))
    _write(arguments.out, published.files(measured))
    return GOOD


def _write(folder: str, files: dict[str, bytes | str]) -> None:
    print("\nWritten:")
    for path in output.write_together(folder, files):
        print(f"  {path}")
