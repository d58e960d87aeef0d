// A tool against planes, in closed form.
#pragma once

#include "mpm/tool/tool.h"

namespace mpm::testing {

// Least signed distance (mm) of the plane through `at` with unit `normal` from the ring at `pose`: the major
// circle reaches down Ro sin(angle between axis and normal).
inline double ring_over_plane(const Tool& tool, const ToolPose& pose, const Vec3& at, const Vec3& normal) {
  const double down = tool.major_radius * pose.axis.cross(normal).norm();
  return normal.dot(pose.torus_center - at) - down - tool.minor_radius;
}

// Height (mm) of the torus centre of the upright tool that rests on the plane z = slope x, over plan point x.
inline double rest_height(const Tool& tool, double slope, double x) {
  const double length = std::hypot(slope, 1);
  return slope * x + std::abs(slope) * tool.major_radius + length * tool.minor_radius;
}

// The part of a tool's touches that a tilt of the insert brings to zero: by bisection, the tilt in (0, most)
// at which the ring meets the plane.
template <class Pose>
double tilt_to_plane(const Tool& tool, const Pose& pose_at, double most, const Vec3& at, const Vec3& normal) {
  double free = 0, inside = most;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (free + inside);
    (ring_over_plane(tool, pose_at(middle), at, normal) > 0 ? free : inside) = middle;
  }
  return free;
}

}  // namespace mpm::testing
