#include "mpm/contact/approach.h"

namespace mpm {

Mat3 Tilt::velocity_slope() const {
  const Vec3& k = insert_.u1;
  Mat3 cross;
  cross << 0, -k.z(), k.y(), k.z(), 0, -k.x(), -k.y(), k.x(), 0;
  return cross;
}

RingDistance ring_distance(const Tool& tool, const ToolPose& pose, const Vec3& s) {
  const Vec3 x = s - pose.torus_center;
  const double z = x.dot(pose.axis);
  const Vec3 radial = x - z * pose.axis;
  const double r = radial.norm();
  const Vec3 out = r > 0 ? Vec3(radial / r) : pose.axis.unitOrthogonal();
  const double to_circle = hypotenuse(r - tool.major_radius, z);
  const double nr = (r - tool.major_radius) / to_circle, nz = z / to_circle;
  const Vec3 around = pose.axis.cross(out), tangent = nr * pose.axis - nz * out;
  RingDistance d;
  d.to_circle = to_circle;
  d.gradient = nr * out + nz * pose.axis;
  d.hessian = tangent * tangent.transpose() / to_circle;
  if (r > 0) d.hessian += (nr / r) * around * around.transpose();
  return d;
}

}  // namespace mpm
