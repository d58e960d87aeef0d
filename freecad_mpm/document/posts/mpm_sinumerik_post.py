"""Siemens 840D with TRAORI and angles: for CAM's Post Process command.

FreeCAD loads this file by its path, so it imports by absolute names (freecad_mpm.document.post_script says more)."""

from __future__ import annotations

from typing import Any

from freecad_mpm.document import post_script

POST = "sinumerik"
TOOLTIP = post_script.TOOLTIP.format("Siemens 840D with TRAORI and angles")
TOOLTIP_ARGS = post_script.TOOLTIP_ARGS
UNITS = post_script.UNITS


def export(objectslist: list[Any], filename: str, argstring: str) -> str:
    return post_script.export(objectslist, filename, POST, argstring)


Mpm_Sinumerik = post_script.post_class(POST, TOOLTIP)
