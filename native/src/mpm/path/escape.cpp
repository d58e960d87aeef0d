#include "mpm/path/escape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "mpm/gouge/certify_motion.h"

namespace mpm {
namespace {

// A way flatter than this would run sideways far over the part.
constexpr double kSteepestWay = radians(75.0);

// A tool this part of the approach distance away counts as that far: sampling and rounding leave a little.
constexpr double kFarEnough = 0.99;

struct Sample {
  double along;  // mm from the position
  double clearance;
};

// Clearance is 1-Lipschitz in a translation, so a clear tool may skip as far as it is clear.
double next_step(double clearance, const EscapeOptions& options) {
  const bool far = clearance >= kFarEnough * options.approach_distance;
  return far ? std::max(options.check_step, clearance) : options.check_step;
}

std::vector<Sample> march(const ClearanceSampler& sampler,
                          const Tool& tool,
                          const TipPose& position,
                          const Vec3& direction,
                          double length,
                          const EscapeOptions& options,
                          const Context& context) {
  std::vector<Sample> samples;
  for (double along = 0;; along = std::min(along + next_step(samples.back().clearance, options), length)) {
    const ToolPose pose = ToolPose::from_tip(tool, position.tip + along * direction, position.axis);
    samples.push_back({along, sampler(pose, options.approach_distance).distance});
    if (along >= length || context.cancelled()) return samples;
  }
}

// Where the tool gets clear for good, seen from the position.
double plunge_length(const std::vector<Sample>& samples, double approach_distance) {
  double length = std::min(approach_distance, samples.back().along);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i)
    if (samples[i].clearance < kFarEnough * approach_distance)
      length = std::max(length, samples[i + 1].along);
  return length;
}

Escape try_direction(const ClearanceSampler& sampler,
                     const Tool& tool,
                     const TipPose& position,
                     const Vec3& direction,
                     const EscapeOptions& options,
                     const Context& context) {
  const double length = (options.safe_z - position.tip.z()) / direction.z();
  const std::vector<Sample> samples = march(sampler, tool, position, direction, length, options, context);
  double least = options.approach_distance;
  for (const Sample& s : samples) least = std::min(least, s.clearance);
  const double allowed = std::min(samples.front().clearance, 0.0) - options.gouge;
  return {
      direction, length, plunge_length(samples, options.approach_distance), least, least < allowed, false};
}

// The two parts of a free way, on which the tool goes up, down or both.
void prove(const CellTree& cells,
           const Tool& tool,
           const TipPose& position,
           const EscapeOptions& options,
           const Context& context,
           Escape& way) {
  const auto pose = [&](const Vec3& tip) { return ToolPose::from_tip(tool, tip, position.axis); };
  const ToolPose start = pose(way.plunge_start(position.tip));
  CertifyMotionOptions ask;
  ask.axis_deviation = options.axis_deviation;
  ask.tolerance = options.depth - options.tip_deviation;
  const MotionCertificate plunge = certify_motion(cells, tool, pose(position.tip), start, ask, context);
  if (plunge.verdict != Verdict::free) return;
  ask.tolerance = -options.tip_deviation;
  way.proven =
      certify_motion(cells, tool, start, pose(way.top(position.tip)), ask, context).verdict == Verdict::free;
  if (way.proven) way.clearance = std::min(plunge.lo, options.tip_deviation) - options.tip_deviation;
}

bool is_better(const Escape& a, const Escape& b) {
  return a.blocked != b.blocked ? b.blocked : a.blocked && a.clearance > b.clearance;
}

}  // namespace

Escape find_escape(const ClearanceSampler& sampler,
                   const CellTree& cells,
                   const Tool& tool,
                   const TipPose& position,
                   const EscapeOptions& options,
                   const Context& context) {
  std::optional<Escape> best;
  for (const Vec3& way : {position.axis, Vec3(position.axis + Vec3::UnitZ()), Vec3(Vec3::UnitZ())}) {
    const Vec3 direction = way.normalized();
    if (direction.z() < std::cos(kSteepestWay)) continue;
    Escape escape = try_direction(sampler, tool, position, direction, options, context);
    if (!escape.blocked) prove(cells, tool, position, options, context, escape);
    if (escape.proven) return escape;
    if (!best || is_better(escape, *best)) best = escape;
  }
  return *best;  // along z is always tried
}

}  // namespace mpm
