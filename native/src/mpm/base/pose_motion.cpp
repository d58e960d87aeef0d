#include "mpm/base/pose_motion.h"

#include <cmath>

#include "mpm/base/direction.h"

namespace mpm {
namespace {

// Below this angle (radians) the chord and the arc between two unit vectors agree to rounding.
constexpr double kStraightAngle = 1e-7;

}  // namespace

TipPose pose_between(const TipPose& a, const TipPose& b, double t) {
  const double angle = angle_between(a.axis, b.axis);
  const double from = angle < kStraightAngle ? 1 - t : std::sin((1 - t) * angle);
  const double to = angle < kStraightAngle ? t : std::sin(t * angle);
  return {(1 - t) * a.tip + t * b.tip, (from * a.axis + to * b.axis).normalized()};
}

}  // namespace mpm
