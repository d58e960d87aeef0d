// The point of a patch that is nearest to the ring, or deepest in it.
#pragma once

#include "mpm/contact/patch_search.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Least signed distance (mm) of a patch from the ring near (u, v), by PatchSearch at a fixed pose: searched,
// not proven. What cannot lead under `floor` (mm) is not followed to the end.
PatchMinimum lowest_point(
    const Tool& tool, const ToolPose& pose, const BezierPatch& patch, double u, double v, double floor);

}  // namespace mpm
