"""`bench`: compare the methods and write bench.json."""

from __future__ import annotations

from argparse import ArgumentParser, Namespace

from ..base import output, pages
from ..bench import comparison, degrees, picture, published, scaling, summary
from .common import GOOD, Files, add_threads, write
from .console import ProgressLine


def arguments(parser: ArgumentParser) -> None:
    """All may be left out: the thesis' surfaces, all methods, files into out/."""
    parser.add_argument(
        "--surfaces", nargs="+", metavar="NAME", help="shipped examples or job files; default: thesis"
    )
    parser.add_argument("--methods", nargs="+", metavar="NAME", help="default: all")
    parser.add_argument(
        "--published",
        action="store_true",
        help="instead: the thesis' tables 2 and 3, its figures beside ours",
    )
    parser.add_argument("--out", metavar="DIR", default="out", help="folder for bench.json; default: out")
    parser.add_argument("--csv", metavar="FILE", help="also write the rows to this file in --out, as CSV")
    parser.add_argument(
        "--scaling",
        action="store_true",
        help="instead: how exact's time grows with positions, size, tolerance",
    )
    parser.add_argument(
        "--markdown",
        metavar="PAGE",
        nargs="+",
        default=[],
        help="pages whose generated tables are written anew",
    )
    add_threads(parser)


def run(given: Namespace, progress: ProgressLine) -> int:
    """Compute first and write last: an error, a page without markers among them, leaves all files as they were."""
    output.check_folder(given.out)
    if given.published:
        return _published(given, progress)
    texts = {name: pages.read(name) for name in given.markdown}
    blocks, files = (_scaling if given.scaling else _comparison)(given, progress)
    rewritten = {name: pages.replaced(text, blocks, name) for name, text in texts.items()}
    write(given.out, files)
    for name, text in rewritten.items():
        output.write_atomically(name, text)
        print(f"  {name}")
    return GOOD


def _comparison(given: Namespace, progress: ProgressLine) -> tuple[dict[str, str], Files]:
    runs = comparison.runs(given.surfaces, given.methods, given.threads)
    rows = [comparison.measure(run, progress) for run in runs]
    searches = [] if given.surfaces else degrees.measure(runs, progress)
    tables = summary.blocks(rows, searches)
    progress.clear()
    print(comparison.table(rows))
    for claim, source, ours in tables["claims"].rows:
        print(f"\n{claim} ({source}):\n  {ours}")
    files: Files = {
        "bench.json": comparison.to_json(rows, {"searches": searches}),
        "bench.png": picture.draw(rows),
    }
    if given.csv:
        files[given.csv] = comparison.to_csv(rows)
    return {name: table.markdown() for name, table in tables.items()}, files


def _scaling(given: Namespace, progress: ProgressLine) -> tuple[dict[str, str], Files]:
    rows = scaling.run(progress)
    table = scaling.table(rows).markdown()
    progress.clear()
    print(table)
    files: Files = {"scaling.json": comparison.to_json(rows)}
    if given.csv:
        files[given.csv] = comparison.to_csv(rows)
    return {"scaling": table}, files


def _published(given: Namespace, progress: ProgressLine) -> int:
    measured = []
    for one in published.measure_all(on_progress=progress, threads=given.threads):
        measured.append(one)
        progress.clear()
        print(published.table([one.row]).splitlines()[-1], flush=True)
    print("\n" + published.table([one.row for one in measured]))
    write(given.out, published.files(measured))
    return GOOD
