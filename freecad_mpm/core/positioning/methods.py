"""The methods of the core, and what a job asks of one."""

from __future__ import annotations

from ... import _core
from ..base import suggestion
from ..job import Job, MethodSpec


def method_names() -> list[str]:
    """The methods of the core, in its order."""
    return list(_core.METHODS)


def guarantee_of(job: Job) -> str:
    """What the job's method says of its clearances: "sampled" or "proven"."""
    return str(_core.METHODS[job.method.name]["guarantee"])


def check_method(job: Job) -> None:
    """Raise InputError unless the core has the job's method and its options."""
    method = job.method
    if method.name not in _core.METHODS:
        raise job.error(
            MethodSpec.table,
            "name",
            f"unknown method '{method.name}'{suggestion(method.name, _core.METHODS)}",
        )
    if method.contact_spacing_mm and not _core.METHODS[method.name]["spins"]:
        able = " and ".join(name for name, one in _core.METHODS.items() if one["spins"])
        raise job.error(
            MethodSpec.table,
            "contact_spacing_mm",
            f"must be 0 for {method.name}, which cannot spin; {able} can",
        )
    known = _core.METHODS[method.name]["options"]
    for name, value in method.options.items():
        if name not in known:
            raise job.error(MethodSpec.table, f"options.{name}", f"unknown option{suggestion(name, known)}")
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise job.error(MethodSpec.table, f"options.{name}", f"must be a number, got {value!r}")


def method_options(job: Job) -> dict[str, float]:
    """The method's options: what it may cut in is the job's gouge tolerance, unless its own table says otherwise."""
    options: dict[str, float] = dict(job.method.options)
    if "gouge_mm" in _core.METHODS[job.method.name]["options"]:
        options.setdefault("gouge_mm", job.tolerance.gouge_mm)
    return options
