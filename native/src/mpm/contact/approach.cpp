#include "mpm/contact/approach.h"

namespace mpm {

RingDistance ring_distance(const Tool& tool, const ToolPose& pose, const Vec3& s) {
  const Vec3 x = s - pose.torus_center;
  const double z = x.dot(pose.axis);
  const Vec3 radial = x - z * pose.axis;
  const double r = radial.norm();
  const Vec3 out = r > 0 ? Vec3(radial / r) : pose.axis.unitOrthogonal();
  const double inverse_r = r > 0 ? 1 / r : 0;
  const double to_circle = hypotenuse(r - tool.major_radius, z);
  const double nr = (r - tool.major_radius) / to_circle, nz = z / to_circle;
  const Vec3 around = pose.axis.cross(out), tangent = nr * pose.axis - nz * out;
  return {nr * out + nz * pose.axis, tangent, around, 1 / to_circle, nr * inverse_r, -inverse_r * out};
}

}  // namespace mpm
