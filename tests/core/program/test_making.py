"""A program is described, written, read back and checked by one call; the check shares nothing with the writer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from machine_samples import two_passes

from freecad_mpm.core.base import Stages
from freecad_mpm.core.job import Job, MachineSpec, Part, PostSpec, ToolSpec
from freecad_mpm.core.machine import Machine, move_machine
from freecad_mpm.core.path import ToolPath
from freecad_mpm.core.posts import ProgramTool
from freecad_mpm.core.program import Made, ProgramPart, find_shop, make_program

BOX = (np.array([-5.0, -5.0, -25.0]), np.array([85.0, 59.0, 25.0]))


def job_of(machine: str = "table_bc", tcp: bool = False) -> Job:
    return Job(
        part=Part("none"),
        tool=ToolSpec(6.7, 6.0),
        machine=MachineSpec(machine),
        post=PostSpec("linuxcnc", tcp=tcp),
    )


def made(job: Job, parts: int = 1, machine: Machine | None = None) -> Made:
    shop = find_shop(job)
    kind, tip, axis, feed = two_passes()
    count = len(kind)
    path = ToolPath(
        kind, tip, axis, *np.full((2, count), -1), np.zeros(count), *np.zeros((2, count), dtype=bool)
    )
    joints = move_machine(job, machine or shop.machine, path, feed)
    part = ProgramPart(path, joints, BOX)
    others = [replace(part, tool=ProgramTool(number, 5.0, 1.0)) for number in range(2, parts + 1)]
    return make_program(job, shop, [part, *others], Stages(), "NAME")


@pytest.mark.parametrize("tcp", [True, False])
@pytest.mark.parametrize("parts", [1, 3])
def test_what_is_made_has_been_read_back(tcp: bool, parts: int) -> None:
    found = made(job_of("linuxcnc_xyzac" if tcp else "table_bc", tcp), parts)
    assert found.troubles == [] and found.checks.findings == []
    assert found.program.file_name == "NAME.ngc" and found.blocks > parts * 80
    assert [program.tool.number for program in found.programs] == list(range(1, parts + 1))
    assert found.checks.tip_error_mm < 1e-3


def test_a_figure_of_several_parts_is_not_made_up() -> None:
    with pytest.raises(ValueError):
        made(job_of(), parts=2).report


def test_a_wrong_datum_of_the_writer_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """The writer takes its datum from the machine, the check from kinematics of its own: one mistake does not cancel."""
    right = Machine.datum_mm.fget(find_shop(job_of()).machine)  # type: ignore[attr-defined]
    monkeypatch.setattr(Machine, "datum_mm", right + [0.0, 0.0, 0.02])
    found = made(job_of())
    assert "round trip" in {one.check for one in found.checks.findings}
    assert "findings of the program's checks" in found.troubles[0]


@pytest.mark.parametrize("tcp", [True, False])
def test_a_wrong_axis_of_the_path_is_found(tcp: bool) -> None:
    """Joints of a machine whose first rotary axis turns the other way."""
    job = job_of("linuxcnc_xyzac" if tcp else "table_bc", tcp)
    machine = find_shop(job).machine
    first, second = machine.rotary_axes
    other = replace(machine, rotary_axes=(replace(first, sense=-first.sense), second))
    assert "round trip" in {one.check for one in made(job, machine=other).checks.findings}
