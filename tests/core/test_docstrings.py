"""Every public class, function, method and property of the package says in its docstring what its name does not."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

# Names that others prescribe, who say what they are for, each with who calls it.
PRESCRIBED = {
    "FreeCAD's commands": {"GetResources", "IsActive", "Activated"},
    "FreeCAD's proxies": {"dumps", "loads", "onDocumentRestored"},
    "FreeCAD's view providers": {
        "attach",
        "claimChildren",
        "doubleClicked",
        "getDefaultDisplayMode",
        "getDisplayModes",
        "getIcon",
        "setDisplayMode",
        "updateData",
    },
    "FreeCAD's task panels": {"getStandardButtons", "reject"},
    "FreeCAD's observers": {"slotDeletedDocument", "slotDeletedObject", "slotRecomputedObject"},
    "FreeCAD's selection gates": {"allow"},
    "CAM's operations": {"initOperation", "opFeatures", "opOnDocumentRestored"},
    "CAM's pages": {"getFields", "getForm", "getSelectionFactory", "getSignalsForUpdate", "setFields"},
    "CAM's posts": {"export"},
}
NAMES = set().union(*PRESCRIBED.values())

Definition = ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef


def public(body: list[ast.stmt], prefix: str = "") -> Iterator[tuple[str, Definition]]:
    """Qualified name and definition; what stands in a private class or in a function is private."""
    for node in body:
        if isinstance(node, Definition) and not node.name.startswith("_"):
            yield prefix + node.name, node
            if isinstance(node, ast.ClassDef):
                yield from public(node.body, f"{prefix}{node.name}.")


def without_docstring(text: str) -> list[str]:
    return [
        name
        for name, node in public(ast.parse(text).body)
        if not ast.get_docstring(node) and node.name not in NAMES
    ]


def sources() -> list[Path]:
    return sorted((ROOT / "freecad_mpm").rglob("*.py"))


def test_every_public_definition_has_a_docstring() -> None:
    missing = [
        f"{path.relative_to(ROOT)}: {name}"
        for path in sources()
        for name in without_docstring(path.read_text())
    ]
    assert missing == []


@pytest.mark.parametrize(
    ("text", "missing"),
    [
        ("def f():\n    pass", ["f"]),
        ("async def f():\n    pass", ["f"]),
        ('def f():\n    ""', ["f"]),
        ("class A:\n    def f(self):\n        'said'", ["A"]),
        ("class A:\n    'said'\n    @property\n    def f(self):\n        return 1", ["A.f"]),
        ("class A:\n    'said'\n    class B:\n        'said'\n        def f(self): ...", ["A.B.f"]),
        ("def f():\n    'said'\n    def g(): ...", []),
        ("def _f(): ...\nclass _A:\n    def f(self): ...", []),
        ("class A:\n    'said'\n    def __len__(self): ...\n    def getIcon(self): ...", []),
    ],
)
def test_a_definition_without_one_is_found(text: str, missing: list[str]) -> None:
    assert without_docstring(text) == missing


def test_every_prescribed_name_is_there() -> None:
    defined = {node.name for path in sources() for _, node in public(ast.parse(path.read_text()).body)}
    assert NAMES <= defined
