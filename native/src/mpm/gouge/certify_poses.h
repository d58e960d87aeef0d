// The judge over many poses at once, whoever found them.
#pragma once

#include <vector>

#include "mpm/base/context.h"
#include "mpm/gouge/certify_pose.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

// One certificate a pose, in parallel. `tolerance` (mm, positive) is what may be cut in, and how sharp lo is
// for a pose that is free. Of a pose that cuts in deeper hi is the deepest surface point met, by dense
// sampling and by the search; lo is at most a thousandth of the depth below it, or -infinity where that could
// not be proven within the budget.
//
// Method: certify_pose(); where that is not free, again and again with the depth found so far as tolerance.
// Requires: finite poses with unit axes, in the model's frame; a tool that passes check_tool().
// Guarantees: in the order of the poses, whatever the number of threads.
// Fails: std::invalid_argument for a tolerance that is not positive. What a cancel left out is undecided.
std::vector<PoseCertificate> certify_poses(const SurfaceModel& model,
                                           const Tool& tool,
                                           const std::vector<ToolPose>& poses,
                                           double tolerance,
                                           Context& context);

}  // namespace mpm
