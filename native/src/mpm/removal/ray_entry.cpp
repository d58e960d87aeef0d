#include "mpm/removal/ray_entry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mpm {
namespace {

// Real roots of a s^2 + b s + c, ascending; infinite where there is none. The larger root by size is formed
// without cancellation and the other from their product.
std::pair<double, double> quadratic_roots(double a, double b, double c) {
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0) return {kInfinity, kInfinity};
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return a == 0 ? std::pair{kInfinity, kInfinity} : std::pair{0.0, 0.0};
  const double first = a == 0 ? kInfinity : q / a, second = c / q;
  return std::minmax(first, second);
}

}  // namespace

VerticalRay::VerticalRay(const ToolPose& pose, double x, double y) {
  const Vec2 d(x - pose.torus_center.x(), y - pose.torus_center.y());
  axial0 = d.dot(pose.axis.head<2>());
  axial1 = pose.axis.z();
  square2 = pose.axis.head<2>().squaredNorm();  // 1 - axis.z^2 without cancellation
  square1 = -2 * axial0 * axial1;
  square0 = d.squaredNorm() - axial0 * axial0;
}

double cone_entry(const VerticalRay& ray, double bottom_radius, double top_radius, double z0, double z1) {
  const double enter = (z0 - ray.axial0) / ray.axial1, leave = (z1 - ray.axial0) / ray.axial1;
  // Inside the slab the ray is in the cone where square(s) <= (r0 + r1 s)^2.
  const double slope = (top_radius - bottom_radius) / (z1 - z0);
  const double r0 = bottom_radius + slope * (ray.axial0 - z0), r1 = slope * ray.axial1;
  const double a = ray.square2 - r1 * r1, b = ray.square1 - 2 * r0 * r1, c = ray.square0 - r0 * r0;
  if ((a * enter + b) * enter + c <= 0) return enter;
  const auto [first, second] = quadratic_roots(a, b, c);
  const double root = first > enter ? first : second;
  return root > enter && root <= leave ? root : kInfinity;
}

double ring_entry(const VerticalRay& ray, const Tool& tool, double tolerance, double limit) {
  const double leave = std::min(limit, -ray.axial0 / ray.axial1);
  for (double s = (-tool.minor_radius - ray.axial0) / ray.axial1; s < leave;) {
    const double radius = std::sqrt(std::max(ray.square(s), 0.0));
    const double distance = std::hypot(radius - tool.major_radius, ray.axial(s)) - tool.minor_radius;
    if (distance <= tolerance) return s;
    s += distance;
  }
  return kInfinity;
}

double lowest_point(
    const Tool& tool, const ToolPose& pose, double x, double y, double tolerance, double limit) {
  const VerticalRay ray(pose, x, y);
  double lowest = limit - pose.torus_center.z();
  const auto lower = [&](double bottom, double top, double z0, double z1) {
    lowest = std::min(lowest, cone_entry(ray, bottom, top, z0, z1));
  };
  double top = tool.flute_length - tool.minor_radius;
  lower(tool.radius(), tool.radius(), 0.0, top);
  if (tool.major_radius > 0)
    lower(tool.major_radius, tool.major_radius, tool.recess - tool.minor_radius, top);
  for (const ToolSegment& s : tool.segments) {
    lower(s.bottom_radius, s.top_radius, top, top + s.length);
    top += s.length;
  }
  lowest = std::min(lowest, ring_entry(ray, tool, tolerance, lowest));
  const double height = pose.torus_center.z() + lowest;
  return height < limit ? height : kInfinity;
}

}  // namespace mpm
