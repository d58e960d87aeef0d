// The second opinion over many poses at once, whoever found them: the least clearance that dense sampling
// finds.
#pragma once

#include <vector>

#include "mpm/base/context.h"
#include "mpm/surface/surface_model.h"
#include "mpm/tool/tool.h"

namespace mpm {

// One number a pose, in parallel: the least signed distance (mm) of sampled surface points from the tool, at
// most the cutter's radius.
//
// Requires: poses in the model's frame, axes of unit length; a tool that passes check_tool().
//
// Guarantees: the clearance of the pose is at most this; nothing is proven the other way. The result does not
// depend on the number of threads.
//
// Fails: infinity for a pose that is not finite, and for those that a cancelled context leaves out.
std::vector<double> sample_poses(const SurfaceModel& model,
                                 const Tool& tool,
                                 const std::vector<ToolPose>& poses,
                                 Context& context);

}  // namespace mpm
