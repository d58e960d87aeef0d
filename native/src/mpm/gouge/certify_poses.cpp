#include "mpm/gouge/certify_poses.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/gouge/judge_cells.h"

namespace mpm {
namespace {

constexpr std::size_t kGrain = 4;  // poses a task

constexpr double kAsDeep = 1.001;  // a point less than this much deeper is not looked for
constexpr int kMostRounds = 64;
constexpr std::uint32_t kDeepBudget =
    5000;  // cells a round; surface as deep all along a curve takes any number

struct Judge {
  const CellTree& tree;
  const ClearanceSampler& sampler;
  const Tool& tool;
  double tolerance;  // mm

  PoseCertificate operator()(const ToolPose& pose) const;
  void find_deepest(const ToolPose& pose, PoseCertificate& found) const;
};

PoseCertificate Judge::operator()(const ToolPose& pose) const {
  CertifyPoseOptions options;
  options.tolerance = options.sharpness = tolerance;
  options.stop_at_violation = true;
  PoseCertificate found = certify_pose(tree, tool, pose, options);
  if (found.verdict != Verdict::free) find_deepest(pose, found);
  return found;
}

// Dense sampling gives nearly the depth; asked with that as the tolerance, few cells stay open, until nothing
// deeper is found.
void Judge::find_deepest(const ToolPose& pose, PoseCertificate& found) const {
  found.hi = std::min(found.hi, sampler(pose, tool.radius()).distance);
  CertifyPoseOptions options;
  options.budget = kDeepBudget;
  for (int round = 0; round < kMostRounds; ++round) {
    options.tolerance = options.sharpness = std::max(tolerance, -kAsDeep * found.hi);
    const PoseCertificate next = certify_pose(tree, tool, pose, options);
    found.cells += next.cells;
    found.lo = next.lo;
    if (next.hi < found.hi) found.hi = next.hi, found.witness = next.witness;
    if (next.verdict != Verdict::gouge) break;
  }
  found.verdict = found.hi < -tolerance    ? Verdict::gouge
                  : found.lo >= -tolerance ? Verdict::free
                                           : Verdict::undecided;
}

}  // namespace

std::vector<PoseCertificate> certify_poses(const SurfaceModel& model,
                                           const Tool& tool,
                                           const std::vector<ToolPose>& poses,
                                           double tolerance,
                                           Context& context) {
  require(std::isfinite(tolerance) && tolerance > 0, "tolerance_mm must be a positive number of mm");
  const CellTree tree = judge_cells(model, tool);
  const ClearanceSampler sampler(model, tool);
  const Judge judge{tree, sampler, tool, tolerance};
  std::vector<PoseCertificate> found(poses.size());
  context.start(poses.size());
  for_each_range(poses.size(), kGrain, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i) found[i] = judge(poses[i]);
  });
  return found;
}

}  // namespace mpm
