"""The add-on as FreeCAD and its Addon Manager see it."""

from __future__ import annotations

import re
from pathlib import Path

import FreeCAD
import pytest

from freecad_mpm.document import properties

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "freecad_mpm"
ICON_BYTES_MAX = 10_000
# What only one version of FreeCAD has, or has under that name.
VERSION_WORDS = re.compile(
    r"FreeCAD\.Version\(|\bPathScripts\b|\bPath\.(Op|Main|Base|Tool|Post|Preferences)\b|\bPySide[26]\b"
)


def test_freecad_reads_the_manifest() -> None:
    manifest = FreeCAD.Metadata(str(ROOT / "package.xml"))
    assert (manifest.Name, manifest.Version) == ("Multi-Point Machining", "0.1.0")
    assert str(manifest.FreeCADMin).startswith("0.20")
    assert [one["name"] for one in manifest.License] == ["LGPL-2.1-or-later"]
    (workbench,) = manifest.Content["workbench"]
    assert f"class {workbench.Classname}(" in (ROOT / "InitGui.py").read_text()
    assert (ROOT / workbench.Icon).is_file() and (ROOT / manifest.Icon).is_file()
    assert (ROOT / manifest.License[0]["file"]).is_file()


@pytest.mark.parametrize("icon", sorted((ROOT / "resources/icons").glob("*.svg")), ids=lambda path: path.stem)
def test_icons_are_small_squares(icon: Path) -> None:
    text = icon.read_text()
    assert 'width="64" height="64"' in text
    assert len(text) < ICON_BYTES_MAX


@pytest.mark.parametrize("folder", ["document", "gui"])
def test_versions_are_known_in_one_file_only(folder: str) -> None:
    found = [path.name for path in (PACKAGE / folder).rglob("*.py") if VERSION_WORDS.search(path.read_text())]
    assert set(found) <= {"compat.py"}


@pytest.mark.parametrize("one", properties.PROPERTIES, ids=lambda one: one.name)
def test_properties_are_explained_in_a_sentence(one: properties.Property) -> None:
    assert one.group and one.doc[0].isupper() and not one.doc.endswith(".")
