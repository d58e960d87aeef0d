#include "mpm/removal/stroke.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "mpm/base/direction.h"
#include "mpm/base/error.h"

namespace mpm {
namespace {

constexpr double kUnitTolerance = 1e-6;  // of the length of an axis that comes from a file
// A stroke may miss a second dip of the ring's distance over its time by this depth at most, mm.
constexpr double kMissedDip = 5e-4;
constexpr double kStraightAngle = 1e-9;  // radians: the axis does not turn

Stroke make_stroke(const Tool& tool, const TipPose& a, const TipPose& b, std::uint32_t move) {
  Stroke s{a.tip,
           b.tip - a.tip,
           a.axis,
           Vec3::Zero(),
           angle_between(a.axis, b.axis),
           move,
           tool.minor_radius,
           (b.tip - a.tip).norm(),
           {},
           {}};
  const Vec3 across = b.axis - b.axis.dot(a.axis) * a.axis;
  if (s.angle < kStraightAngle)
    s.angle = 0;
  else
    s.side = across.normalized();
  s.ends = {s.at(0), s.at(1)};
  s.middle = s.at(0.5);
  return s;
}

}  // namespace

void check_swept_path(const SweptPath& path) {
  require(path.removes.size() == path.poses.size(), "tip, axis and removes must have the same length");
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const TipPose& p = path.poses[i];
    require(p.tip.allFinite(), "tip: pose " + std::to_string(i) + " is not finite");
    require(std::abs(p.axis.norm() - 1) < kUnitTolerance,
            "axis: pose " + std::to_string(i) + " must be a unit vector");
  }
}

StrokePose Stroke::at(double time) const {
  if (angle == 0) return {tip + time * travel + minor_radius * axis, axis, travel, Vec3::Zero()};
  // Taylor sums, exact to rounding up to kStrokeAngle.
  const double x = time * angle, q = x * x;
  const double s = x * (1 - q / 6 * (1 - q / 20 * (1 - q / 42)));
  const double c = 1 - q / 2 * (1 - q / 12 * (1 - q / 30));
  const Vec3 now = c * axis + s * side, rate = angle * (c * side - s * axis);
  return {tip + time * travel + minor_radius * now, now, travel + minor_radius * rate, rate};
}

double longest_travel(const Tool& tool) {
  const double ro = tool.major_radius, ri = tool.minor_radius;
  // Over a straight way of length L across a circle of radius Ro the distance from it can have two minima
  // whose depth differs from the maximum between them by less than (L^2 / 8 Ro)^2 / 2 Ri at the ring's
  // surface.
  const double one_dip = std::sqrt(8 * ro * std::sqrt(2 * ri * kMissedDip));
  return one_dip > 0 ? std::min(one_dip, tool.radius()) : tool.radius();
}

std::vector<Stroke> make_strokes(const Tool& tool, const SweptPath& path) {
  const double longest = longest_travel(tool);
  std::vector<Stroke> strokes;
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    if (!path.removes[i]) continue;
    const TipPose &a = path.poses[i - 1], &b = path.poses[i];
    const double parts =
        std::max((b.tip - a.tip).norm() / longest, angle_between(a.axis, b.axis) / kStrokeAngle);
    const int count = std::max(1, int(std::ceil(parts)));
    for (int k = 0; k < count; ++k)
      strokes.push_back(make_stroke(tool,
                                    pose_between(a, b, double(k) / count),
                                    pose_between(a, b, double(k + 1) / count),
                                    std::uint32_t(i)));
  }
  return strokes;
}

}  // namespace mpm
