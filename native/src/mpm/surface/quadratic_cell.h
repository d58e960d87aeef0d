// A piece of surface as a quadratic in two variables with a proven error: what every bound is computed from.
#pragma once

#include <algorithm>

#include "mpm/surface/bezier_patch.h"
#include "mpm/surface/cell_batch.h"

namespace mpm {

// For every surface point s of the piece there are a, b in [-1, 1] with
//   |s - (c + a A + b B + a^2 C + a b E + b^2 F)| <= error,
// a running over the piece's u range and b over its v range. c is the surface point at a = b = 0.
struct QuadraticCell {
  Vec3 c, A, B, C, E, F;
  double error = 0;   // mm
  double radius = 0;  // mm: no point of the piece is farther from c

  void set_radius() {
    radius = std::max((A + B).norm(), (A - B).norm()) + C.norm() + E.norm() + F.norm() + error;
  }
};

// One lane of a batch, written and read.
void put_lane(CellBatch& batch, int lane, const QuadraticCell& cell);
QuadraticCell get_lane(const CellBatch& batch, int lane);

// Bound (mm) of |D^3 S [x, x, x]| for x in [-1, 1]^2, the third derivative along any such direction anywhere
// in `part`, with a and b scaled to the part; from the control points' differences.
double third_derivative_bound(const BezierPatch& part);

// The patch `part` (restricted to the piece wanted) as a cell: interpolates the surface at the nine points a,
// b in {-1, 0, 1} up to the corners' mean; the error is bounded by the control points of the difference.
QuadraticCell interpolating_cell(const BezierPatch& part);

// The piece of `patch` over `box` by Taylor's formula; `third` bounds the third derivative as above, scaled
// to `box`.
QuadraticCell taylor_cell(const BezierPatch& patch, const ParamBox& box, double third);

// `inner` seen from `outer`: the bound of |inner(a', b') - outer(a, b)| over the inner piece, which covers
// a = a0 + ka a', b = b0 + kb b' of the outer one, plus the inner error.
double distance_from(
    const QuadraticCell& inner, const QuadraticCell& outer, double a0, double ka, double b0, double kb);

}  // namespace mpm
