"""Tests of the document layer: they run inside FreeCAD's command line (./dev test starts it)."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

import pytest

try:
    import FreeCAD
except ImportError:
    if os.environ.get("MPM_REQUIRE_FREECAD"):
        raise
    collect_ignore_glob = ["test_*.py"]
else:
    from parts import free_form_block

    @pytest.fixture
    def doc() -> Iterator[Any]:
        """An empty document; all documents are closed afterwards."""
        yield FreeCAD.newDocument("test")
        for name in list(FreeCAD.listDocuments()):
            FreeCAD.closeDocument(name)

    @pytest.fixture
    def block(doc: Any) -> Any:
        """A block of 60 x 40 mm whose Face5, the top, is a free-form face."""
        return free_form_block(doc)

    @pytest.fixture
    def op(doc: Any, block: Any) -> Any:
        """A computed operation on the block's top, with few positions."""
        from parts import COARSE, TOP

        import freecad_mpm

        return freecad_mpm.create(doc, [(block, TOP)], **COARSE)
