// Angles and great circles of unit vectors.
#pragma once

#include <cmath>

#include "mpm/base/frame.h"

namespace mpm {

// Angle between two vectors, 0..pi, accurate to a few roundoffs everywhere (arccos is not near 0 and pi).
inline double angle_between(const Vec3& a, const Vec3& b) { return std::atan2(a.cross(b).norm(), a.dot(b)); }

// The unit vector a fraction s of the way from a to b on their great circle; a itself when that is not
// defined.
inline Vec3 great_circle(const Vec3& a, const Vec3& b, double s) {
  const Vec3 normal = a.cross(b);
  const double length = normal.norm();
  if (length == 0) return a;
  return rotation(normal / length, s * std::atan2(length, a.dot(b))) * a;
}

}  // namespace mpm
