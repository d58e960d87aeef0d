// The pseudo-insert through the first contact and the tilt about it (methods: drop and tilt, VCRF;
// docs/methods).
#pragma once

#include <cmath>

#include "mpm/tool/tool.h"

namespace mpm {

// The insert frame: origin O1 on the major circle, w1 = tool axis before the tilt, v1 from O1 to the torus
// centre, u1 = v1 x w1, the axis of the tilt. The minor circle through the first contact lies in the plane of
// v1 and w1.
struct Insert {
  Vec3 center, u1, v1, w1;

  Vec3 to_local(const Vec3& s) const {
    const Vec3 d = s - center;
    return {d.dot(u1), d.dot(v1), d.dot(w1)};
  }
};

// Of the cutter's radius: a contact nearer to the tool's axis than this has no insert; which way it lies is
// rounding or Newton's tolerance.
inline constexpr double kOnAxis = 1e-7;

// The insert of a tool at `pose` towards a first contact; requires `first_contact` off the tool axis.
inline Insert insert_through(const Tool& tool, const ToolPose& pose, const Vec3& first_contact) {
  const Vec3 inward = pose.torus_center - first_contact;
  const Vec3 v1 = (inward - inward.dot(pose.axis) * pose.axis).normalized();
  return {pose.torus_center - tool.major_radius * v1, v1.cross(pose.axis), v1, pose.axis};
}

// The tool tilted by `tilt` (radians) about u1, far side down; it keeps touching where the minor circle does.
inline ToolPose tilted(const Tool& tool, const Insert& insert, double tilt) {
  const double c = std::cos(tilt), s = std::sin(tilt);
  return {insert.center + tool.major_radius * (c * insert.v1 - s * insert.w1), c * insert.w1 + s * insert.v1};
}

// The unit normal of the ring at its point nearest to s, from s to the tube's centre; requires s off the tool
// axis and off the major circle.
inline Vec3 ring_normal(const Tool& tool, const ToolPose& pose, const Vec3& s) {
  const Vec3 from_center = s - pose.torus_center;
  const Vec3 radial = from_center - from_center.dot(pose.axis) * pose.axis;
  return (pose.torus_center + tool.major_radius * radial.normalized() - s).normalized();
}

// A tilt given by a positive multiple of its cosine and sine; NaN for none.
struct TiltDirection {
  double c, s;
  // Radians, in (-pi/2, 3 pi/2]: no motion starts with the tool turned farther back.
  double angle() const {
    const double tilt = std::atan2(s, c);
    return tilt <= -kPi / 2 ? tilt + 2 * kPi : tilt;
  }
  // Grows with angle(), without its cost; NaN for none.
  double order() const {
    const double part = s / (std::abs(s) + std::abs(c));
    return c < 0 ? 2 - part : c > 0 || s > 0 ? part : 3;
  }
};

// The tilt at which the ring reaches a surface point, given in the insert frame: the point's circle about u1
// meets the lower half of the torus there. None where it never does. Closed form: with the power g = |s|^2 -
// Ri^2 of the point against the insert's ball, y = Ro + g/(4 Ro) - Ro su^2/g and z = -sqrt(sv^2 + sw^2 -
// y^2); the squared torus terms cancel. Requires Ro > 0. A point inside the ball (g <= 0) has none: no tilt
// brings the ring to it.
inline TiltDirection circular_ray_direction(const Tool& tool, const Vec3& local) {
  const double power = local.squaredNorm() - tool.minor_radius * tool.minor_radius;
  if (!(power > 0)) return {kNaN, kNaN};
  const double ro = tool.major_radius;
  const double y = ro + power / (4 * ro) - ro * local.x() * local.x() / power;
  const double z2 = local.y() * local.y() + local.z() * local.z() - y * y;
  if (!(z2 >= 0)) return {kNaN, kNaN};
  // The angle from the point's direction to that of its meeting with the ring.
  const double z = -std::sqrt(z2);
  return {y * local.y() + z * local.z(), z * local.y() - y * local.z()};
}

// The same as an angle, radians; NaN for none.
inline double circular_ray(const Tool& tool, const Vec3& local) {
  return circular_ray_direction(tool, local).angle();
}

}  // namespace mpm
