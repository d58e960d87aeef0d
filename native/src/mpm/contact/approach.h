// One-parameter motions that bring the ring to the surface: the drop and the tilt, each with its exact
// derivatives.
#pragma once

#include "mpm/contact/drop.h"
#include "mpm/contact/insert.h"
#include "mpm/contact/patch_search.h"

namespace mpm {

// A motion of the tool with parameter x; the ring meets a surface point s at x = arrival(s). The tool's first
// touch is the least arrival over the surface. `velocity`, `velocity_slope` and `acceleration` describe how a
// surface point moves relative to the tool: ds/dx = w(s), dw/ds, d2s/dx2.
// Lowering an upright tool over plan point `at` along -z; x = -(height of the torus centre), mm.
class Drop {
 public:
  Drop(const Tool& tool, const Vec2& at) : tool_(tool), at_(at) {}
  double arrival(const Vec3& s) const { return -drop_height(tool_, at_, s); }
  ToolPose pose(double x) const { return {Vec3(at_.x(), at_.y(), -x), Vec3::UnitZ()}; }
  Vec3 velocity(const Vec3&) const { return Vec3::UnitZ(); }
  Mat3 velocity_slope() const { return Mat3::Zero(); }
  Vec3 acceleration(const Vec3&) const { return Vec3::Zero(); }

 private:
  const Tool& tool_;
  Vec2 at_;
};

// Tilting about the pseudo-insert, far side down; x = tilt, radians.
class Tilt {
 public:
  Tilt(const Tool& tool, const Insert& insert) : tool_(tool), insert_(insert) {}
  double arrival(const Vec3& s) const {
    const double x = circular_ray(tool_, insert_.to_local(s));
    return x == x ? x : kInfinity;
  }
  ToolPose pose(double x) const { return tilted(tool_, insert_, x); }
  Vec3 velocity(const Vec3& s) const { return insert_.u1.cross(s - insert_.center); }
  Mat3 velocity_slope() const;
  Vec3 acceleration(const Vec3& s) const { return insert_.u1.cross(velocity(s)); }
  const Vec3& axis() const { return insert_.u1; }
  const Vec3& center() const { return insert_.center; }

 private:
  const Tool& tool_;
  const Insert& insert_;
};

// Gradient (unit, away from the tool) and Hessian of the distance from the major circle, at surface point s.
struct RingDistance {
  double to_circle;
  Vec3 gradient;
  Mat3 hessian;
};
RingDistance ring_distance(const Tool& tool, const ToolPose& pose, const Vec3& s);

// Derivatives of the arrival x at `p` by the implicit function theorem on distance(s(u, v), pose(x)) = 0. The
// gradient is NaN where the motion is tangent to the ring there.
template <class Approach>
Derivatives arrival_derivatives(const Tool& tool, const Approach& approach, const SurfacePoint& p, double x) {
  Derivatives a;
  a.value = x;
  const RingDistance d = ring_distance(tool, approach.pose(x), p.s);
  const Vec3 w = approach.velocity(p.s);
  const Mat3 slope = approach.velocity_slope();
  const double dx = d.gradient.dot(w);
  if (!(dx < 0)) return a;
  a.gap_rate = -dx;
  const Vec3 hu = d.hessian * p.su, hv = d.hessian * p.sv;
  const double dux = hu.dot(w) + d.gradient.dot(slope * p.su), dvx = hv.dot(w) + d.gradient.dot(slope * p.sv);
  const double dxx = w.dot(d.hessian * w) + d.gradient.dot(approach.acceleration(p.s));
  const double xu = -d.gradient.dot(p.su) / dx, xv = -d.gradient.dot(p.sv) / dx;
  a.gradient = {xu, xv};
  const double duv = hu.dot(p.sv) + d.gradient.dot(p.suv);
  a.hessian(0, 0) = -(hu.dot(p.su) + d.gradient.dot(p.suu) + 2 * dux * xu + dxx * xu * xu) / dx;
  a.hessian(1, 1) = -(hv.dot(p.sv) + d.gradient.dot(p.svv) + 2 * dvx * xv + dxx * xv * xv) / dx;
  a.hessian(0, 1) = a.hessian(1, 0) = -(duv + dux * xv + dvx * xu + dxx * xu * xv) / dx;
  return a;
}

}  // namespace mpm
