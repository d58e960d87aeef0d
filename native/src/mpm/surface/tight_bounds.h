// The box of a trimmed face itself, not of its control points.
#pragma once

#include "mpm/surface/bezier_patch.h"
#include "mpm/surface/trim_region.h"

namespace mpm {

// How near the box comes, relative to the size of the patch.
inline constexpr double kTightness = 1e-9;

// Extends `box` by the part of `patch` inside `trim`: points of the face are added, and pieces that could
// still reach beyond the box are halved, down to 1/256 of the patch, where a piece's control points count as
// the piece. The result contains the face but for kTightness and, along a slanting trimming curve, for the
// bulge between two points on it 1/256 of the patch apart; it reaches beyond the face by less than that.
// Bounded work; starting with a good box makes it quick.
void extend_by_face(Box3& box, const BezierPatch& patch, const TrimRegion& trim);

}  // namespace mpm
