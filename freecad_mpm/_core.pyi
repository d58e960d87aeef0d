"""The door to the C++ core: every name of `_core`, in the order of native/bindings/core/module.cpp.

native/bindings/README.md says how the two sides meet. Arrays go in as anything that numpy takes for one; what comes
back is new, row-major, and of the type and shape that stands here. Lengths are mm; vectors are in the set-up frame where
nothing else is said. The TypedDict classes describe dictionaries and exist for the type checker only.
tests/core/test_door.py holds all of it to the module."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Codes = NDArray[np.uint8]  # indices into a tuple of names
Int32s = NDArray[np.int32]
Int64s = NDArray[np.int64]
UInt32s = NDArray[np.uint32]
UInt64s = NDArray[np.uint64]

# ---------------------------------------------------------------------------------------------- base

class Context:
    """Progress and cancel of one long call, to be read and cancelled from another thread."""

    def __init__(self, threads: int = 0) -> None: ...  # 0: all cores
    def cancel(self) -> None: ...
    @property
    def cancelled(self) -> bool: ...
    @property
    def done(self) -> int: ...
    @property
    def total(self) -> int: ...

def pose_between(
    tip: ArrayLike,  # (3,)
    axis: ArrayLike,  # (3,), any length
    tip_to: ArrayLike,  # (3,)
    axis_to: ArrayLike,  # (3,), any length, not opposite to axis
    fraction: float,
) -> tuple[Floats, Floats]: ...  # (3,), (3,): tip on the line, unit axis on the great circle

# ---------------------------------------------------------------------------------------------- surface

class BSplineSurface:
    """A B-spline surface of degree 1 to 10, rational or not."""

    def __init__(
        self,
        degree_u: int,
        degree_v: int,
        knots_u: ArrayLike,  # (nu + degree_u + 1,), multiplicities written out
        knots_v: ArrayLike,  # (nv + degree_v + 1,)
        poles: ArrayLike,  # (nu, nv, 3) mm
        weights: ArrayLike | None = None,  # (nu, nv)
    ) -> None: ...
    @property
    def domain(self) -> tuple[float, float, float, float]: ...  # u0, u1, v0, v1
    def evaluate(self, u: ArrayLike, v: ArrayLike) -> Floats: ...  # (N, 6, 3): S, Su, Sv, Suu, Suv, Svv

class Face:
    """A surface with its trimming loops; a check face is kept clear of, not machined."""

    def __init__(
        self,
        name: str,
        surface: BSplineSurface,
        trim_loops: Sequence[ArrayLike] = ...,  # closed polygons (N, 2) in (u, v), even-odd; none: untrimmed
        check: bool = False,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def check(self) -> bool: ...

class SurfaceModel:
    """All faces to machine and to keep clear of."""

    def __init__(self, faces: Sequence[Face]) -> None: ...
    @property
    def patches(self) -> int: ...
    def bounds(self) -> tuple[Floats, Floats]: ...  # (3,), (3,) mm: corners lo, hi of the box of all faces
    def machined_bounds(self) -> tuple[Floats, Floats]: ...  # (3,), (3,) mm: of the faces to machine

# ---------------------------------------------------------------------------------------------- tool

class Tool:
    """A toroidal cutter with flutes, shank and holder; all mm."""

    def __init__(
        self,
        major_radius_mm: float,
        minor_radius_mm: float,
        recess_mm: float,
        flute_length_mm: float,
        segments: Sequence[tuple[float, float, float]] = ...,  # bottom radius, top radius, length; upwards
    ) -> None: ...
    @property
    def major_radius(self) -> float: ...
    @property
    def minor_radius(self) -> float: ...
    @property
    def recess(self) -> float: ...
    @property
    def flute_length(self) -> float: ...
    @property
    def radius(self) -> float: ...
    @property
    def length(self) -> float: ...
    @property
    def reach(self) -> float: ...
    def signed_distance(self, tip: ArrayLike, axis: ArrayLike, points: ArrayLike) -> Floats: ...  # (N,) mm

# ---------------------------------------------------------------------------------------------- footprint

def raster(
    lo: ArrayLike,  # (2,) mm, in plan
    hi: ArrayLike,
    *,
    direction_deg: float,
    side_step_mm: float,
    forward_step_mm: float,
    margin_mm: float = 0.0,
    zigzag: bool = False,
) -> tuple[Floats, UInt32s]: ...  # (N, 2), (N,): points in plan, index of the pass

# ---------------------------------------------------------------------------------------------- gouge

class Certificates(TypedDict):
    lo: Floats  # (N,) mm: proven lower bound of the clearance; -inf: none
    hi: Floats  # (N,) mm: it is at most this, a surface point has it; inf: none came near
    verdict: Codes  # (N,) of VERDICTS
    cells: UInt64s  # (N,) pieces of surface looked at

class CellTree:
    """The faces in pieces of all sizes, with bounds: what proofs about one tool work on."""

    def __init__(self, model: SurfaceModel, tool: Tool) -> None: ...

VERDICTS: tuple[str, ...]

def certify_poses(
    model: SurfaceModel,
    tool: Tool,
    tips: ArrayLike,  # (N, 3)
    axes: ArrayLike,  # (N, 3)
    *,
    tolerance_mm: float,
    context: Context,
) -> Certificates: ...
def sampled_clearance(
    model: SurfaceModel,
    tool: Tool,
    tips: ArrayLike,  # (N, 3)
    axes: ArrayLike,  # (N, 3)
    context: Context,
) -> Floats: ...  # (N,) mm, at most the tool's radius
def certify_motions(
    cells: CellTree,
    tool: Tool,
    tips: ArrayLike,  # (N, 3)
    axes: ArrayLike,  # (N, 3)
    tips_to: ArrayLike,  # (N, 3)
    axes_to: ArrayLike,  # (N, 3)
    *,
    tolerance_mm: ArrayLike,  # a number or (N,): may be cut in; negative: the clearance asked for
    axis_deviation_deg: ArrayLike = ...,  # a number or (N,): of the axis from its great circle; 0
    context: Context,
) -> Certificates: ...

# ---------------------------------------------------------------------------------------------- positioning

class Method(TypedDict):
    guarantee: Literal["proven", "sampled"]
    spins: bool
    options: dict[str, float]  # the method's own numbers with their source's values

class Placements(TypedDict):
    tip: Floats  # (N, 3)
    axis: Floats  # (N, 3) unit
    contacts: Floats  # (N, 2, 3) at P and at Q; NaN: none
    normals: Floats  # (N, 2, 3) unit, there, to the tool; NaN: none
    status: Codes  # (N,) of POSITION_STATUS
    tilt_deg: Floats  # (N,)
    spin_deg: Floats  # (N,)
    clearance: Floats  # (N, 2) mm: lower and upper bound; infinite: nobody proved or measured one
    counters: dict[str, int]  # evaluations (of surface points), newton_steps, cells (bounded), seeds

class SpacedPlacements(Placements):
    contact_spacing_mm: Floats  # (N,) that each position has; NaN: none
    nearest_spacing_mm: Floats  # (N,) of all spins, what comes nearest to the wanted one; NaN: none

METHODS: dict[str, Method]
POSITION_STATUS: tuple[str, ...]

class Positioner:
    """A method of METHODS, with its options, made ready for one model and tool."""

    def __init__(
        self,
        method: str,
        model: SurfaceModel,
        tool: Tool,
        *,
        tilt_max_deg: float = 45.0,
        spin_deg: float = 0.0,
        options: Mapping[str, float] = ...,
        cells: CellTree | None = None,  # of the model and the tool; None: the method makes its own
    ) -> None: ...
    def place(
        self,
        points: ArrayLike,  # (N, 2) in plan
        *,
        spins_deg: ArrayLike | None = None,  # (N,), in place of the positioner's own
        context: Context,
    ) -> Placements: ...
    def place_spins(  # N K rows, point by point
        self,
        points: ArrayLike,  # (N, 2) in plan
        spins_deg: ArrayLike,  # (K,)
        *,
        context: Context,
    ) -> Placements: ...
    def place_spaced(
        self,
        points: ArrayLike,  # (N, 2) in plan
        pass_index: Sequence[int] | NDArray[np.integer[Any]],  # (N,): points of one pass follow each other
        contact_spacing_mm: float,
        *,
        measure: str = "across",  # or "direct"
        feed: ArrayLike,  # (3,): `across` is seen along it
        samples: int = 36,  # spins looked at on the circle
        context: Context,
    ) -> SpacedPlacements: ...
    def place_contacts(  # tilt_deg of the result: 0 on the ring's equator, 90 on its bottom
        self,
        faces: Sequence[int] | NDArray[np.integer[Any]],  # (N,) indices into the model's
        uv: ArrayLike,  # (N, 2)
        ring_directions: ArrayLike,  # (N, 3) tangent of the ring at the contact
        *,
        context: Context,
    ) -> Placements: ...

def restrict_to_faces(
    model: SurfaceModel,
    tool: Tool,
    points: ArrayLike,  # (N, 2) in plan
    margin_mm: float = 0.0,
) -> Flags: ...  # (N,): over a face to machine, or within the margin of one

# ---------------------------------------------------------------------------------------------- machine

class RotaryAxis:
    """A rotary axis; a reading is positive as ISO 841 has it (docs/machine.md)."""

    def __init__(
        self,
        *,
        name: str,  # one letter
        role: str,  # "table_rotary" or "head_rotary"
        rotation_vector: ArrayLike,  # (3,), machine frame
        joint_origin_mm: ArrayLike = ...,  # (3,), machine frame
        sense: int = 1,
        zero_offset_deg: float = 0.0,
        min_limit_deg: float = ...,  # infinite limits: an unwound axis
        max_limit_deg: float = ...,
        max_velocity_deg_per_min: float = ...,
        max_acceleration_deg_per_s2: float = ...,
    ) -> None: ...
    @property
    def name(self) -> str: ...

class LinearAxis:
    """X, Y or Z."""

    def __init__(
        self,
        *,
        min_limit_mm: float = ...,
        max_limit_mm: float = ...,
        max_velocity_mm_per_min: float = ...,
        max_acceleration_mm_per_s2: float = ...,
    ) -> None: ...

class PartSetup:
    """Where the part stands on the machine, and how long the tool is."""

    def __init__(
        self,
        *,
        part_origin_mm: ArrayLike = ...,  # (3,) of the set-up frame in the machine frame
        tool_length_mm: float = 0.0,  # from the spindle gauge point to the tip
    ) -> None: ...

class InverseSolutions(TypedDict):
    rotary_deg: Floats  # (N, 2, 2) readings: two solutions, two axes
    linear_mm: Floats  # (N, 2, 3) readings: two solutions, X, Y, Z
    reachable: Flags  # (N,) else the nearest orientation is given
    pole_distance_deg: Floats  # (N,)

class KinematicChain:
    """Two rotary axes, listed from the part to the tool, and X, Y, Z."""

    def __init__(
        self,
        *,
        rotary: Sequence[RotaryAxis],  # 2
        linear: Sequence[LinearAxis] = ...,  # 3
        spindle_axis: ArrayLike = ...,  # (3,), machine frame
        solution_preference: str = "shortest",  # or "positive", "negative"
        allow_flip: bool = True,
    ) -> None: ...
    def forward(
        self,
        linear_mm: ArrayLike,  # (N, 3) readings
        rotary_deg: ArrayLike,  # (N, 2) readings
        *,
        setup: PartSetup = ...,
    ) -> tuple[Floats, Floats]: ...  # (N, 3), (N, 3): tip in mm, unit axis
    def deviation_bound(
        self,
        linear_mm: ArrayLike,  # (N, 3) readings
        rotary_deg: ArrayLike,  # (N, 2)
        linear_to_mm: ArrayLike,  # (N, 3)
        rotary_to_deg: ArrayLike,  # (N, 2)
        *,
        setup: PartSetup = ...,
    ) -> tuple[Floats, Floats]: ...  # (N,), (N,): mm off the tip's line, degrees off the axis' great circle
    def inverse(
        self,
        tip: ArrayLike,  # (N, 3)
        axis: ArrayLike,  # (N, 3), any length
        *,
        setup: PartSetup = ...,
    ) -> InverseSolutions: ...

class JointPath(TypedDict):
    rotary_deg: Floats  # (M, 2) readings, unwound
    linear_mm: Floats  # (M, 3) readings
    branch: Codes  # (M,) which of the two solutions
    at_pole: Flags  # (M,) inside the pole cone
    status: Codes  # (M,) of JOINT_STATUS

class RefinedPath(JointPath):
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3) unit
    source: UInt32s  # (M,) index of the given move
    keeps: Flags  # (M,) the move keeps its tolerances all along

JOINT_STATUS: tuple[str, ...]

def joint_path(
    chain: KinematicChain,
    tip: ArrayLike,  # (N, 3)
    axis: ArrayLike,  # (N, 3), any length
    cutting: ArrayLike,  # (N,) flags
    *,
    setup: PartSetup = ...,
    pole_cone_deg: float = 0.0,
) -> JointPath: ...
def refine_path(
    chain: KinematicChain,
    tip: ArrayLike,  # (N, 3)
    axis: ArrayLike,  # (N, 3), any length
    cutting: ArrayLike,  # (N,) flags
    *,
    setup: PartSetup = ...,
    pole_cone_deg: float = 0.0,
    axis_tolerance_deg: float,  # of the axis off its great circle
    tip_tolerance_mm: float = ...,  # of the tip off its line; finite: rapids are split too
    max_rotary_step_deg: float = ...,
) -> RefinedPath: ...

# ---------------------------------------------------------------------------------------------- path

class ToolPath(TypedDict):
    kind: Codes  # (M,) of MOVE_KINDS
    tip: Floats  # (M, 3)
    axis: Floats  # (M, 3) unit
    position: Int64s  # (M,) index of the position that the move ends in, or -1
    pass_index: Int32s  # (M,)
    clearance: Floats  # (M,) mm: least sampled along the move, or its proven bound
    proven: Flags  # (M,)
    blocked: Flags  # (M,) no free way was found

MOVE_KINDS: tuple[str, ...]

class LinkOptions:
    """Heights, distances and limits of the links between cuts (native path/link_passes.h)."""

    def __init__(
        self,
        *,
        safe_clearance_mm: float = 5.0,
        approach_distance_mm: float = 2.0,
        gouge_mm: float = 0.01,
        cut_gouge_mm: float = 0.2,
        check_step_mm: float = 1.0,
        cut_length_max_mm: float = 10.0,
        cut_turn_max_deg: float = ...,  # 15
        rapid_turn_max_deg: float = ...,  # 5
        depth_mm: float = 0.01,
        tip_deviation_mm: float = 0.0,
        axis_deviation_deg: float = 0.0,
    ) -> None: ...

def link_passes(
    cells: CellTree,
    tool: Tool,
    tip: ArrayLike,  # (N, 3)
    axis: ArrayLike,  # (N, 3) unit
    pass_index: ArrayLike,  # (N,)
    usable: ArrayLike,  # (N,) flags
    *,
    options: LinkOptions = ...,
    cut_clearance: ArrayLike | None = None,  # (N,) mm proven of the cut that ends there, NaN: must not be cut
    context: Context,
) -> ToolPath: ...

# ---------------------------------------------------------------------------------------------- removal

class ToolSweep:
    """What a tool sweeps on its way."""

    def __init__(
        self,
        tool: Tool,
        tip: ArrayLike,  # (M, 3)
        axis: ArrayLike,  # (M, 3) unit
        removes: ArrayLike,  # (M,) flags: does the move from pose i - 1 to pose i take material away?
    ) -> None: ...
    @property
    def strokes(self) -> int: ...

class DexelStock:
    """A block of stock as dexels along x, y and z."""

    def __init__(self, lo: ArrayLike, hi: ArrayLike, cell_mm: float) -> None: ...
    @staticmethod
    def bytes_needed(lo: ArrayLike, hi: ArrayLike, cell_mm: float) -> int: ...
    @property
    def counts(self) -> list[int]: ...  # 3: nodes along x, y, z
    @property
    def bytes(self) -> int: ...
    @property
    def volume_mm3(self) -> float: ...
    def cut(self, sweep: ToolSweep, context: Context) -> None: ...
    def dexel(self, axis: int, u: int, v: int) -> list[tuple[float, float]]: ...  # spans of material, mm
    def mesh(self) -> tuple[Floats, UInt32s]: ...  # (V, 3), (T, 3): vertices, triangles seen from outside

class SurfaceSamples(TypedDict):
    points: Floats  # (N, 3)
    normals: Floats  # (N, 3) unit, z >= 0
    at: Floats  # (N, 2) parameters
    face: UInt32s  # (N,) index into the model's faces
    triangles: UInt32s  # (T, 3) between points of one face

def cut_rays(
    sweep: ToolSweep,
    origins: ArrayLike,  # (N, 3) on the true surface
    directions: ArrayLike,  # (N, 3) unit, outwards
    height: ArrayLike,  # (N,) mm: of the material before the cut
    *,
    move: ArrayLike | None = None,  # (N,) that cut there before; None: none did
    below_mm: float,  # how deep a gouge is looked for
    context: Context,
) -> tuple[Floats, Int32s]: ...  # (N,), (N,): height after the cut in mm, the move that cut there or -1
def overcut(
    tool: Tool,
    tip: ArrayLike,  # (M, 3)
    axis: ArrayLike,  # (M, 3) unit
    removes: ArrayLike,  # (M,) flags, as of ToolSweep
    points: ArrayLike,  # (N, 3) that are to stay
    *,
    context: Context,
) -> tuple[Floats, Int32s]: ...  # (N,), (N,): mm inside what is swept, the move that goes deepest or -1
def sample_surfaces(
    model: SurfaceModel,
    *,
    spacing_mm: float,
    lo: ArrayLike,  # (3,): faces well outside of lo..hi are left out
    hi: ArrayLike,
    context: Context,
) -> SurfaceSamples: ...
