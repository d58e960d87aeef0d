"""The checkout keeps the rules of docs/architecture.md, and each rule catches what it forbids."""

import subprocess
from collections.abc import Callable
from pathlib import Path

import architecture as rules
import pytest

ROOT = Path(__file__).resolve().parents[2]
Rule = Callable[[Path], list[str]]

TABLE = """
| layer | native module | charter | may use |
|---|---|---|---|
| 0 | `base` | low | – |
| 1 | `surface` | faces | base |
| 2 | `contact` | one point | 0–1 |
| 3 | `gouge` | the judge | 0–2 |
| 4 | `positioning` | the methods | 0–3 |
| 5 | `path` | order | 0–4 |
| 6 | `machine` | joints | 0–2, path |
| side | `occt` | files | base, surface |

| package | charter | may import |
|---|---|---|
| `freecad_mpm._core`, `freecad_mpm._occt` | native | – |
| `freecad_mpm.core` | no FreeCAD | `_core`, numpy |
| `freecad_mpm.document` | FreeCAD App | `core`, FreeCAD |
| `freecad_mpm.gui` | window | `document`, `core`, FreeCAD, FreeCADGui, Qt |

| room | charter | may use |
|---|---|---|
| `base` | low | – |
| `machine` | joints | base |
| `posts` | writers | base, machine |
| `control` | readers | machine |
| `program` | both | machine, posts, control |
"""

# rule, file, text that it must object to
FORBIDDEN = [
    (rules.native_includes_follow_the_table, "native/src/mpm/gouge/a.h", '#include "mpm/positioning/b.h"'),
    (rules.native_includes_follow_the_table, "native/src/mpm/base/a.cpp", '#include "mpm/surface/b.h"'),
    (rules.native_includes_follow_the_table, "native/src/mpm/machine/a.cpp", '#  include "mpm/gouge/b.h"'),
    (rules.native_includes_follow_the_table, "native/src/mpm/surface/a.cpp", '#include "mpm/occt/b.h"'),
    (rules.native_includes_follow_the_table, "native/src/mpm/base/a.inc", '#include "mpm/surface/b.h"'),
    (rules.native_includes_follow_the_table, "native/src/mpm/novel/a.cpp", "int x;"),
    (
        rules.native_permissions_are_used,
        "docs/architecture.md",
        TABLE.replace("| faces | base", "| faces | base, occt"),
    ),
    (rules.judge_is_independent, "docs/architecture.md", TABLE.replace("0–2 |\n| 4", "0–4 |\n| 4")),
    (rules.tbb_has_one_door, "native/src/mpm/path/a.cpp", "#include <tbb/parallel_for.h>"),
    (rules.tbb_has_one_door, "native/bindings/core/a.cpp", "#include <oneapi/tbb.h>"),
    (rules.opencascade_stays_in_occt, "native/src/mpm/surface/a.cpp", "#include <gp_Pnt.hxx>"),
    (rules.opencascade_stays_in_occt, "native/bindings/core/a.cpp", "#include <TopoDS.hxx>"),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/base/a.cpp", 'void f() { printf("x"); }'),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/base/a.cpp", "void f() { std::cerr << 1; }"),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/base/a.h", "void f() { assert(x > 0); }"),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/base/a.h", "void f() { std::abort(); }"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.cpp", "bool f(double x) { return x < 1e-9; }"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.cpp", "void f() { double x = 1.5E-3; }"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.h", "void f() { g(1e-12); }"),
    (rules.python_imports_follow_the_table, "freecad_mpm/core/a.py", "import FreeCAD"),
    (
        rules.python_imports_follow_the_table,
        "freecad_mpm/core/a.py",
        "def f():\n    from PySide2 import QtCore",
    ),
    (rules.python_imports_follow_the_table, "freecad_mpm/core/posts/a.py", "from ...document import b"),
    (rules.python_imports_follow_the_table, "freecad_mpm/core/a.py", "import scipy.optimize"),
    (rules.python_imports_follow_the_table, "freecad_mpm/document/a.py", "from freecad_mpm import gui"),
    (rules.python_imports_follow_the_table, "freecad_mpm/document/a.py", "import FreeCADGui"),
    (rules.no_import_runs_in_a_circle, "freecad_mpm/gui/nodes.py", "from . import panel"),
    (rules.no_import_runs_in_a_circle, "freecad_mpm/gui/nodes.py", "def f():\n    from .panel import show"),
    (rules.no_import_runs_in_a_circle, "freecad_mpm/document/model.py", "from .model import faces"),
    (rules.rooms_follow_the_table, "freecad_mpm/core/machine/a.py", "from ..posts import load"),
    (rules.rooms_follow_the_table, "freecad_mpm/core/novel/a.py", "from ..base import InputError"),
    (
        rules.rooms_follow_the_table,
        "docs/architecture.md",
        TABLE.replace("readers | machine", "readers | base, machine"),
    ),
    (rules.doors_are_used, "freecad_mpm/core/program/a.py", "from ..posts.dmu80p import write"),
    (rules.doors_are_used, "freecad_mpm/document/a.py", "from ..core.machine import secret"),
    (rules.doors_are_used, "freecad_mpm/gui/a.py", "from ..core.posts import dmu80p"),
    (rules.checks_share_nothing_with_the_writer, "freecad_mpm/core/control/a.py", "from ..posts import load"),
    (
        rules.checks_share_nothing_with_the_writer,
        "freecad_mpm/core/control/kinematics.py",
        "from .. import program",
    ),
    (
        rules.checks_share_nothing_with_the_writer,
        "freecad_mpm/core/program/a.py",
        "from ..control import kinematics",
    ),
    (
        rules.checks_share_nothing_with_the_writer,
        "freecad_mpm/document/a.py",
        "from ..core.control import kinematics",
    ),
    (rules.stands_alone, "notes/a.md", "see ../shared/design.md"),
    (rules.stands_alone, "dev", "cat /work/notes"),
]

# rule, file, text that it must accept
ALLOWED = [
    (
        rules.native_includes_follow_the_table,
        "native/src/mpm/machine/a.cpp",
        '#include "mpm/path/b.h"\n#include <map>',
    ),
    (rules.native_includes_follow_the_table, "native/src/mpm/occt/a.cpp", '#include "mpm/surface/b.h"'),
    (rules.judge_is_independent, "docs/architecture.md", TABLE),
    (rules.tbb_has_one_door, "native/src/mpm/base/parallel.cpp", "#include <tbb/parallel_for.h>"),
    (rules.opencascade_stays_in_occt, "native/src/mpm/occt/a.cpp", "#include <gp_Pnt.hxx>"),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/base/a.h", "static_assert(true);  // assert(x)"),
    (
        rules.core_neither_prints_nor_aborts,
        "native/src/mpm/base/a.h",
        'auto s = "abort()"; int snprintf(int);',
    ),
    (rules.core_neither_prints_nor_aborts, "native/src/mpm/occt/a.cpp", "std::cout.rdbuf(nullptr);"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.cpp", "constexpr double kX = 1e-9;  // not 1e-8"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.h", "struct O {\n  double gouge = 1e-3;\n};"),
    (rules.small_numbers_have_names, "native/src/mpm/base/a.cpp", "double f() { return 1e+9 + 1e6 + 0.5; }"),
    (
        rules.python_imports_follow_the_table,
        "freecad_mpm/core/a.py",
        "import json\nfrom .. import _core\nimport numpy",
    ),
    (
        rules.python_imports_follow_the_table,
        "freecad_mpm/core/posts/a.py",
        "from .. import base\nfrom . import program",
    ),
    (
        rules.python_imports_follow_the_table,
        "freecad_mpm/gui/a.py",
        "import FreeCADGui\nfrom ..document import b",
    ),
    (rules.no_import_runs_in_a_circle, "freecad_mpm/gui/nodes.py", "from ..document import panel"),
    (rules.no_import_runs_in_a_circle, "freecad_mpm/gui/other.py", "from . import nodes, panel"),
    (rules.doors_are_used, "freecad_mpm/core/program/a.py", "from .. import posts\nfrom ..posts import load"),
    (rules.checks_share_nothing_with_the_writer, "freecad_mpm/core/control/a.py", "from . import kinematics"),
    (rules.stands_alone, "tests/core/test_a.py", 'DATA = "../shared/data"'),
    (rules.stands_alone, "notes/a.md", "a shared vocabulary"),
]

ALL_RULES = list(dict.fromkeys(rule for rule, _, _ in FORBIDDEN))


def case_name(value: object) -> str | None:
    return getattr(value, "__name__", None)


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A tiny checkout that keeps all rules."""
    for module, others in rules.native_layers(TABLE).items():
        includes = "\n".join(f'#include "mpm/{other}/all.h"' for other in sorted(others))
        put(tmp_path, f"native/src/mpm/{module}/all.h", includes)
    for name, text in {
        "docs/architecture.md": TABLE,
        "freecad_mpm/core/base/__init__.py": "__all__ = ['x']",
        "freecad_mpm/core/machine/__init__.py": "from ..base import x\n__all__ = ['load']",
        "freecad_mpm/core/posts/__init__.py": "from .dmu80p import load\n__all__ = ['load']",
        "freecad_mpm/core/posts/dmu80p.py": "from .. import base, machine",
        "freecad_mpm/core/control/__init__.py": "from . import kinematics\n__all__ = ['kinematics']",
        "freecad_mpm/core/control/kinematics.py": "from .. import machine",
        "freecad_mpm/core/program/__init__.py": "from .both import both\n__all__ = ['both']",
        "freecad_mpm/core/program/both.py": "from .. import control, machine, posts",
        "freecad_mpm/gui/panel.py": "from .view import show",
        "freecad_mpm/gui/view.py": "from . import nodes",
        "freecad_mpm/gui/nodes.py": "from ..document import model",
    }.items():
        put(tmp_path, name, text)
    return tmp_path


def put(root: Path, name: str, text: str) -> None:
    path = root / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


@pytest.mark.parametrize("rule", ALL_RULES, ids=case_name)
def test_the_checkout_keeps_the_rule(rule: Rule) -> None:
    assert rule(ROOT) == []


@pytest.mark.parametrize("rule", ALL_RULES, ids=case_name)
def test_the_tiny_checkout_keeps_the_rule(rule: Rule, checkout: Path) -> None:
    assert rule(checkout) == []


@pytest.mark.parametrize(("rule", "name", "text"), FORBIDDEN, ids=case_name)
def test_the_rule_objects(rule: Rule, name: str, text: str, checkout: Path) -> None:
    put(checkout, name, text)
    assert len(rule(checkout)) == 1


@pytest.mark.parametrize(("rule", "name", "text"), ALLOWED, ids=case_name)
def test_the_rule_accepts(rule: Rule, name: str, text: str, checkout: Path) -> None:
    put(checkout, name, text)
    assert rule(checkout) == []


def test_the_layer_table_is_read_whole() -> None:
    layers = rules.native_layers(TABLE)
    assert layers["gouge"] == {"base", "surface", "contact"}
    assert layers["machine"] == {"base", "surface", "contact", "path"}
    assert layers["base"] == set()
    with pytest.raises(ValueError, match="nonsense"):
        rules.native_layers(TABLE + "| 7 | `plan` | all | nonsense |\n")


def test_the_package_table_is_read_whole() -> None:
    layers = rules.python_layers(TABLE)
    assert layers["core"] == {"freecad_mpm.core", "freecad_mpm._core", "numpy"}
    assert {"FreeCAD", "Part", "freecad_mpm.core"} <= layers["document"]
    assert layers["_occt"] == {"freecad_mpm._occt"}


def test_the_room_table_is_read_whole() -> None:
    rooms = rules.core_rooms(TABLE)
    assert rooms["program"] == {"machine", "posts", "control"}
    assert rooms["base"] == set()
    with pytest.raises(ValueError, match="later"):
        rules.core_rooms(TABLE + "| `early` | x | later |\n")


@pytest.mark.parametrize("room", rules.rooms_of(ROOT))
def test_every_room_has_a_door_that_says_what_it_is_for(room: str) -> None:
    door = (ROOT / "freecad_mpm/core" / room / "__init__.py").read_text()
    assert "To add " in (rules.ast.get_docstring(rules.ast.parse(door)) or "")
    assert rules.door_names(ROOT, room)


def test_every_room_of_the_table_is_there_and_nothing_else() -> None:
    folders = {path.parent.name for path in (ROOT / "freecad_mpm/core").glob("*/__init__.py")}
    assert folders == set(rules.rooms_of(ROOT))


@pytest.mark.parametrize("room", ["base", "job"])
def test_the_room_opens_without_the_native_module(room: str) -> None:
    block = "import sys; sys.modules['freecad_mpm._core'] = sys.modules['freecad_mpm._occt'] = None; "
    subprocess.run(["/usr/bin/python3", "-c", f"{block}import freecad_mpm.core.{room}"], cwd=ROOT, check=True)


def test_every_module_of_the_table_is_there_and_nothing_else() -> None:
    folders = {path.name for path in (ROOT / "native/src/mpm").iterdir() if path.is_dir()}
    assert folders == set(rules.layers_of(ROOT))


UNTESTED = ROOT / "tests/core/without_own_test.txt"


def test_the_list_of_modules_without_a_test_of_their_name_only_shrinks() -> None:
    """A new module comes with a test of its name; who writes one takes the module's line out of the list."""
    assert rules.without_a_test_of_their_name(ROOT) == UNTESTED.read_text().split()


def test_a_module_without_a_test_is_named(checkout: Path) -> None:
    before = rules.without_a_test_of_their_name(checkout)
    put(checkout, "native/src/mpm/base/novel.h", "")
    put(checkout, "freecad_mpm/core/posts/novel.py", "")
    named = ["core/posts/novel", "native/base/novel"]
    assert [one for one in rules.without_a_test_of_their_name(checkout) if one not in before] == named
    put(checkout, "tests/core/posts/test_novel.py", "")
    put(checkout, "native/tests/base/test_novel.cpp", "")
    assert rules.without_a_test_of_their_name(checkout) == before
