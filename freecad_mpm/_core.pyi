"""The types of the native module are those of its docstrings; only its names are known to the type checker."""

from typing import Any

def __getattr__(name: str) -> Any: ...
