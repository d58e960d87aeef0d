"""The methods compared under one judge; scaling; the published figures beside ours; tables written into pages.

Figures of time are ratios of one run, beside counts that do not depend on the machine.
To add a table: a `summary.Table`, and its block in a page."""

from __future__ import annotations

from . import comparison, degrees, picture, published, scaling, summary

__all__ = ["comparison", "degrees", "picture", "published", "scaling", "summary"]
