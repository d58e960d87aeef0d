// Where a vertical ray from below meets the tool: the lower envelope of the tool's body, one plan point at a
// time.
#pragma once

#include "mpm/tool/tool.h"

namespace mpm {

// A vertical ray seen from the tool: the point at height s above the torus centre has axial coordinate
// axial0 + axial1 s and squared distance from the axis square2 s^2 + square1 s + square0 (mm).
struct VerticalRay {
  VerticalRay(const ToolPose& pose, double x, double y);

  double axial(double s) const { return axial0 + axial1 * s; }
  double square(double s) const { return (square2 * s + square1) * s + square0; }

  double axial0, axial1;
  double square2, square1, square0;
};

// Lowest s at which the ray is inside a truncated cone round the axis, with `bottom_radius` at axial
// coordinate z0 and `top_radius` at z1 (closed form); infinity when it misses. Requires axial1 > 0 and z0 <
// z1.
double cone_entry(const VerticalRay& ray, double bottom_radius, double top_radius, double z0, double z1);

// Lowest s < limit at which the ray is inside the lower half of the ring grown by at most `tolerance` mm
// (sphere tracing); infinity when there is none. Requires axial1 > 0.
double ring_entry(const VerticalRay& ray, const Tool& tool, double tolerance, double limit);

// Height (mm, same frame as the pose) of the lowest point of the tool's body above (x, y), of the ring to
// `tolerance`; infinity when the ray misses the tool or the point is not below `limit`. Requires pose.axis.z
// > 0.
double lowest_point(
    const Tool& tool, const ToolPose& pose, double x, double y, double tolerance, double limit = kInfinity);

}  // namespace mpm
