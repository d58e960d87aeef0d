"""Post-processors for CAM's Post Process command: files named <name>_post.py."""

from __future__ import annotations

import os

FOLDER = os.path.dirname(__file__)


def register() -> None:
    """Add this folder to those where CAM looks for posts."""
    from .. import compat

    compat.register_post_folder(FOLDER)
