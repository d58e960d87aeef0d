#include "mpm/gouge/sample_poses.h"

#include "mpm/base/parallel.h"
#include "mpm/gouge/clearance_sampler.h"

namespace mpm {
namespace {

constexpr std::size_t kPosesATask = 16;  // poses a task

}  // namespace

std::vector<double> sample_poses(const SurfaceModel& model,
                                 const Tool& tool,
                                 const std::vector<ToolPose>& poses,
                                 Context& context) {
  const ClearanceSampler sampler(model, tool);
  std::vector<double> found(poses.size(), kInfinity);
  context.start(poses.size());
  for_each_range(poses.size(), kPosesATask, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i)
      if (poses[i].torus_center.allFinite() && poses[i].axis.allFinite())
        found[i] = sampler(poses[i], tool.radius()).distance;
  });
  return found;
}

}  // namespace mpm
