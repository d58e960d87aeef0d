"""What the pages say exists: links, commands and files; and the pages and scripts agree with each other."""

import re
import subprocess
from pathlib import Path

import architecture
import pytest

from freecad_mpm import _core

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")])
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)")
SHELL_BLOCK = re.compile(r"```sh\n(.*?)```", re.DOTALL)
PAGE = re.compile(r"\bdocs/[\w/-]+\.md\b")
INLINE_COMMAND = re.compile(r"`(\./dev [^`]+|python3 -m freecad_mpm [^`]+|scripts/[^`]+)`")


def page_name(page: Path) -> str:
    return str(page.relative_to(ROOT))


def commands(text: str) -> list[str]:
    """Every command a page shows, in a shell block or inline, without comments."""
    lines = [line for block in SHELL_BLOCK.findall(text) for line in block.splitlines()]
    shown = [line.split("#")[0].strip() for line in lines] + INLINE_COMMAND.findall(text)
    return [command for command in shown if command]


def broken_links(page: Path) -> list[str]:
    return [link for link in LINK.findall(page.read_text()) if not (page.parent / link).exists()]


def dev_words() -> set[str]:
    said = subprocess.run([ROOT / "dev"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (\w+) ", said, re.MULTILINE))


def cli_words() -> set[str]:
    run = ["/usr/bin/python3", "-m", "freecad_mpm", "--help"]
    said = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^ {4}(\w+) ", said, re.MULTILINE))


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_relative_links_resolve(page: Path) -> None:
    assert broken_links(page) == []


def test_a_broken_link_is_found(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("[a](page.md) [b](nowhere.md) ![c](no.png) [d](https://example.org) [e](page.md#part)")
    assert broken_links(page) == ["nowhere.md", "no.png"]


def test_commands_are_found_in_a_page() -> None:
    text = "Say `./dev fix`.\n```sh\ngit clone x  # once\n./dev run\n```\n`dev` and `side_step_mm`"
    assert commands(text) == ["git clone x", "./dev run", "./dev fix"]


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_commands_exist(page: Path) -> None:
    for command in commands(page.read_text()):
        words = command.split()
        if words[0] == "./dev" and len(words) > 1:
            assert words[1] in dev_words(), command
        elif words[:3] == ["python3", "-m", "freecad_mpm"] and words[3:]:
            assert words[3] in cli_words(), command
        elif "/" in words[0]:
            assert (ROOT / words[0]).exists(), command


@pytest.mark.parametrize("page", PAGES, ids=page_name)
def test_resources_exist(page: Path) -> None:
    """Every path below resources/ that a page names is there; <placeholders> and wildcards aside."""
    named = re.findall(r"\bresources/[\w./-]+\.\w+", page.read_text())
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_the_words_of_dev_are_the_agreed_ones() -> None:
    assert dev_words() == {"setup", "run", "test", "build", "check", "fix", "bench"}


def test_an_unknown_word_is_refused() -> None:
    result = subprocess.run([ROOT / "dev", "frobnicate"], capture_output=True, text=True)
    assert result.returncode == 2
    assert result.stderr.splitlines()[-1] == 'dev: unknown word "frobnicate"'


def test_the_ci_runs_the_test_command_of_the_readme() -> None:
    ci = (ROOT / ".ci/run").read_text()
    assert "./dev test" in commands((ROOT / "README.md").read_text())
    assert [line for line in ci.splitlines() if line.startswith("./dev")][-1] == "./dev test"
    assert "export MPM_REQUIRE_FREECAD=1" in ci


def test_every_package_has_a_reason() -> None:
    for line in (ROOT / "packages.txt").read_text().splitlines():
        assert not line or line.startswith("# ") or re.fullmatch(r"[a-z0-9.+-]+ +# \S.*", line), line


def test_the_readme_lists_the_methods_that_there_are() -> None:
    listed = re.findall(
        r"^\| \[`(\w+)`\]\(docs/methods/\w+\.md\) \|.*\| (proven|sampled) \|$",
        (ROOT / "README.md").read_text(),
        re.MULTILINE,
    )
    assert dict(listed) == {name: method["guarantee"] for name, method in _core.METHODS.items()}


def test_the_readme_leads_to_every_page() -> None:
    readme = ROOT / "README.md"
    linked = {(ROOT / link).resolve() for link in LINK.findall(readme.read_text())}
    pages = {page for page in PAGES if page.parent in (ROOT, ROOT / "docs")} - {readme}
    assert pages <= linked


def test_pages_that_the_code_names_exist() -> None:
    """A comment or message that sends the reader to docs/… sends nobody astray."""
    sources = [
        path for path in architecture.text_files(ROOT) if path.suffix in {".h", ".cpp", ".py", ".toml", ".sh"}
    ]
    named = {(path, page) for path in sources for page in PAGE.findall(path.read_text())}
    assert [f"{path}: {page}" for path, page in sorted(named) if not (ROOT / page).exists()] == []
    assert named


def python_example(word: str) -> str:
    """The README's Python example that contains the word."""
    examples = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    return next(example for example in examples if word in example)


def test_the_python_example_runs(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    exec(compile(python_example("freecad_mpm.plan"), "README.md", "exec"), {})
    assert "(776, 3) (776, 3) (776, 2, 3)" in capsys.readouterr().out
