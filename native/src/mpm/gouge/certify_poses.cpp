#include "mpm/gouge/certify_poses.h"

#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"

namespace mpm {
namespace {

constexpr std::size_t kGrain = 16;          // poses a task
constexpr double kLeafPerRadius = 1.0 / 6;  // finest precomputed cells against the cutter's radius

}  // namespace

std::vector<Certificate> certify_poses(const SurfaceModel& model,
                                       const Tool& tool,
                                       const std::vector<ToolPose>& poses,
                                       double tolerance,
                                       Context& context) {
  require(std::isfinite(tolerance) && tolerance > 0, "tolerance_mm must be a positive number of mm");
  const CellTree tree(model, tool.radius() * kLeafPerRadius);
  CertifyOptions options;
  options.tolerance = options.sharpness = tolerance;
  std::vector<Certificate> found(poses.size());
  context.start(poses.size());
  for_each_range(poses.size(), kGrain, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i)
      found[i] = certify_pose(tree, tool, poses[i], options);
  });
  return found;
}

}  // namespace mpm
