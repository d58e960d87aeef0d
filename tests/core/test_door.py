"""The stubs of the native modules say what the modules have: names, parameters, defaults, and every returned table."""

from pathlib import Path

import door
import numpy as np
import pytest

from freecad_mpm import _core, _occt

PACKAGE = Path(_core.__file__).parent
STUBS = {module: (PACKAGE / f"{module.__name__.split('.')[-1]}.pyi").read_text() for module in (_core, _occt)}

KNOTS = np.array([0.0, 0.0, 1.0, 1.0])
POLES = np.array([[[0, 0, 0], [0, 40, 0]], [[40, 0, 0], [40, 40, 0]]], dtype=float)
FLAT = (1, 1, KNOTS, KNOTS, POLES, np.ones((2, 2)))
TOOL = _core.Tool(6.7, 6.0, 6.0, 40.0, [(12.7, 12.7, 30.0)])
TIP, AXIS = np.array([[10.0, 20.0, 0.0], [30.0, 20.0, 0.0]]), np.array([[0.0, 0.0, 1.0]] * 2)
POINTS, TWO, ONCE = TIP[:, :2], np.array([0, 1]), {"context": _core.Context(1)}


def core_examples():
    """A call of each function and an object of each class."""
    surface = _core.BSplineSurface(*FLAT)
    model = _core.SurfaceModel([_core.Face("Face1", surface)])
    cells = _core.CellTree(model, TOOL)
    sweep, stock = _core.ToolSweep(TOOL, TIP, AXIS, [False, True]), _core.DexelStock(
        [0, 0, -2], [40, 40, 2], 4.0
    )
    stock.cut(sweep, **ONCE)
    objects = [_core.Context(), surface, _core.Face("Face1", surface), model, TOOL, sweep, stock]
    calls = {
        "BSplineSurface.evaluate": surface.evaluate([0.1, 0.2, 0.3], [0.4, 0.5, 0.6]),
        "SurfaceModel.bounds": model.bounds(),
        "SurfaceModel.machined_bounds": model.machined_bounds(),
        "Tool.signed_distance": TOOL.signed_distance([0, 0, 0], [0, 0, 1], TIP),
        "raster": _core.raster([0, 0], [40, 40], direction_deg=0, side_step_mm=9, forward_step_mm=7),
        "certify_poses": _core.certify_poses(model, TOOL, TIP, AXIS, tolerance_mm=0.01, **ONCE),
        "certify_motions": _core.certify_motions(
            cells, TOOL, TIP, AXIS, TIP + 1.0, AXIS, tolerance_mm=0.01, **ONCE
        ),
        "sampled_clearance": _core.sampled_clearance(model, TOOL, TIP, AXIS, **ONCE),
        "restrict_to_faces": _core.restrict_to_faces(model, TOOL, POINTS),
        "pose_between": _core.pose_between(TIP[0], AXIS[0], TIP[1], AXIS[1], 0.5),
        "link_passes": _core.link_passes(cells, TOOL, TIP, AXIS, TWO, [True, True], **ONCE),
        "cut_rays": _core.cut_rays(sweep, TIP, AXIS, [2.0, 2.0], below_mm=1.0, **ONCE),
        "overcut": _core.overcut(TOOL, TIP, AXIS, [False, True], TIP, **ONCE),
        "sample_surfaces": _core.sample_surfaces(model, spacing_mm=9, lo=[0, 0, -1], hi=[40, 40, 1], **ONCE),
        "DexelStock.bytes_needed": _core.DexelStock.bytes_needed([0, 0, 0], [1, 1, 1], 0.5),
        "DexelStock.dexel": stock.dexel(2, 1, 1),
        "DexelStock.mesh": stock.mesh(),
    }
    return (
        {type(one).__name__: one for one in objects} | calls | positioner_examples(model) | machine_examples()
    )


def positioner_examples(model):
    placing = _core.Positioner("exact", model, TOOL)
    at = dict(uv=[[0.5, 0.5]], ring_directions=[[0, 1, 0]])
    return {
        "Positioner": placing,
        "Positioner.place": placing.place(POINTS, **ONCE),
        "Positioner.place_spins": placing.place_spins(POINTS, [0.0, 10.0, 20.0], **ONCE),
        "Positioner.place_spaced": placing.place_spaced(POINTS, TWO, 4.0, feed=[0, 1, 0], **ONCE),
        "Positioner.place_contacts": placing.place_contacts([0], **at, **ONCE),
    }


def machine_examples():
    axes = {"C": ("table_rotary", (0, 0, 1)), "B": ("head_rotary", (0, 1, 0))}
    rotary = [
        _core.RotaryAxis(name=name, role=role, rotation_vector=way) for name, (role, way) in axes.items()
    ]
    chain, zero = _core.KinematicChain(rotary=rotary), (np.zeros((3, 3)), np.zeros((3, 2)))
    return {
        "RotaryAxis": rotary[0],
        "KinematicChain.forward": chain.forward(*zero),
        "KinematicChain.deviation_bound": chain.deviation_bound(*zero, *zero),
        "KinematicChain.inverse": chain.inverse(TIP[:1], AXIS[:1]),
        "joint_path": _core.joint_path(chain, TIP, AXIS, [True, True]),
        "refine_path": _core.refine_path(chain, TIP, AXIS, [True, True], axis_tolerance_deg=0.1),
    }


@pytest.fixture(scope="module")
def examples():
    plate = Path(__file__).parent.parent / "data" / "bored_plate.brep"
    read, again = _occt.read_file(str(plate)), _occt.read_brep_string(plate.read_text())
    occt = {
        "read_file": [face for face in read if face["trim_loops"]],
        "read_brep_string": [face for face in again if face["trim_loops"]],
        "evaluate": _occt.evaluate(*FLAT, [0.5], [0.5]),
    }
    return {_core: core_examples(), _occt: occt}


def troubles(module, text, examples):
    stub = door.read(text)
    return [*door.names_and_signatures(stub, module), *door.values(stub, module, examples[module])]


@pytest.mark.parametrize("module", STUBS, ids=lambda module: module.__name__)
def test_the_stub_says_what_the_module_has(module, examples) -> None:
    assert troubles(module, STUBS[module], examples) == []


@pytest.mark.parametrize(
    "written, wrong",
    [
        ("def cancel(self)", "def stop(self)"),
        ("VERDICTS: tuple[str, ...]\n", ""),
        ("MOVE_KINDS: tuple[str, ...]", "MOVE_KINDS: list[str]"),
        ("    @staticmethod\n", ""),
        ("degree_u: int,\n        degree_v: int", "degree_v: int,\n        degree_u: int"),
        ("threads: int = 0", "threads: int"),
        ("threads: int = 0", "threads: int = 1"),
        ("threads: int = 0", "threads: float = 0"),
        ("    *,\n    tolerance_mm: float", "    tolerance_mm: float"),
        ("tool: Tool,\n    points", "tool: Face,\n    points"),
        ("spins_deg: ArrayLike | None", "spins_deg: ArrayLike"),
        ("(self) -> bool: ...", "(self) -> int: ..."),
        (
            "-> tuple[Floats, UInt32s]: ...  # (N, 2), (N,)",
            "-> tuple[Floats, UInt32s]: ...  # (N, 2), (N, 1)",
        ),
        ("-> Flags: ...", "-> Floats: ..."),
        ("    lo: Floats  # (N,)", "    lo: Codes  # (N,)"),
        ("    contacts: Floats  # (N, 2, 3)", "    contacts: Floats  # (N, 3)"),
        ("    face: UInt32s  # (N,)", "    face: UInt32s  # (T,)"),
        ("    keeps: Flags", "    keep: Flags"),
        ("counters: dict[str, int]", "counters: dict[str, float]"),
        ('Literal["proven", "sampled"]', 'Literal["proved", "sampled"]'),
    ],
)
def test_a_stub_that_says_something_else_is_found(written, wrong, examples) -> None:
    assert written in STUBS[_core]
    assert troubles(_core, STUBS[_core].replace(written, wrong, 1), examples)


def test_a_function_without_an_example_is_found(examples) -> None:
    fewer = {_core: {name: value for name, value in examples[_core].items() if name != "raster"}}
    assert troubles(_core, STUBS[_core], fewer) == ["raster: returns something, but no example calls it"]
