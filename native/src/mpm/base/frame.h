// A right-handed orthonormal coordinate frame.
#pragma once

#include "mpm/base/types.h"

namespace mpm {

struct Frame {
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // columns: the frame's x, y and z in the outer frame

  Vec3 to_local(const Vec3& p) const { return axes.transpose() * (p - origin); }
  Vec3 to_outer(const Vec3& p) const { return axes * p + origin; }
  Vec3 direction_to_local(const Vec3& d) const { return axes.transpose() * d; }
  Vec3 direction_to_outer(const Vec3& d) const { return axes * d; }
};

// Rotation by `angle` (radians, right-hand rule) about the unit vector `axis` (Rodrigues).
inline Mat3 rotation(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

}  // namespace mpm
