#include "mpm/contact/lowest_point.h"

#include "mpm/contact/approach.h"

namespace mpm {
namespace {

class GapObjective {
 public:
  GapObjective(const Tool& tool, const ToolPose& pose) : tool_(tool), pose_(pose) {}
  double value(const Vec3& s) const {
    const Vec3 x = s - pose_.torus_center;
    const double z = x.dot(pose_.axis), r = (x - z * pose_.axis).norm();
    return hypotenuse(r - tool_.major_radius, z) - tool_.minor_radius;
  }
  Derivatives derivatives(const SurfacePoint& p, double value) const {
    const RingDistance d = ring_distance(tool_, pose_, p.s);
    const RingDistance::Slope u = d.along(p.su), v = d.along(p.sv);
    Derivatives a;
    a.value = value;
    a.ring_tangent = d.around, a.ring_curvature = d.ring_curvature;
    a.gradient = {u.gradient, v.gradient};
    a.hessian(0, 0) = d.bend(u, p.su) + d.gradient.dot(p.suu);
    a.hessian(1, 1) = d.bend(v, p.sv) + d.gradient.dot(p.svv);
    a.hessian(0, 1) = a.hessian(1, 0) = d.bend(u, p.sv) + d.gradient.dot(p.suv);
    return a;
  }

 private:
  const Tool& tool_;
  const ToolPose& pose_;
};

}  // namespace

PatchMinimum lowest_point(
    const Tool& tool, const ToolPose& pose, const BezierPatch& patch, double u, double v, double floor) {
  const GapObjective objective(tool, pose);
  return PatchSearch<GapObjective>(objective, patch).run(u, v, floor);
}

}  // namespace mpm
