// The neighbourhood of a contact in which the gap between ring and surface is proven convex enough to have
// its minimum there.
#pragma once

#include <optional>

#include "mpm/contact/clearance_bound.h"
#include "mpm/contact/patch_search.h"

namespace mpm {

// Least distance of the ring from a patch near (u, v): Newton's iteration on the signed distance at a fixed
// pose.
PatchMinimum lowest_point(
    const Tool& tool, const ToolPose& pose, const BezierPatch& patch, double u, double v);

// A parallelogram of the parameter plane round `center`, and the clearance proven for the part of the patch
// in it.
struct ContactZone {
  const BezierPatch* patch;
  Vec2 center;
  Eigen::Matrix2d to_unit;  // (u, v) - center -> [-1, 1]^2
  double lower;             // mm

  bool contains(const BezierPatch* of, const ParamBox& box) const;
};

// The largest of four zones round `lowest` (a result of lowest_point on `patch`), along the valley of the
// gap, in which the ring's second-order bound without its first-order terms is positive definite, the terms
// of third order and the loss taken off the squares: there the gap is nowhere less than at the contact, for
// any tolerance. `third`: third_derivative_bound of the whole patch. None where the gap is too nearly flat.
std::optional<ContactZone> contact_zone(const Tool& tool,
                                        const ToolPose& pose,
                                        const ClearanceBound& bound,
                                        const BezierPatch& patch,
                                        double third,
                                        const PatchMinimum& lowest);

}  // namespace mpm
