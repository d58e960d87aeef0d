// One-parameter motions that bring the ring to the surface: the drop and the tilt, each with its exact
// derivatives.
#pragma once

#include <concepts>

#include "mpm/contact/drop.h"
#include "mpm/contact/insert.h"
#include "mpm/contact/patch_search.h"

namespace mpm {

// A motion of the tool with parameter x, in which the ring meets a surface point s at x = arrival(s),
// infinity for never. The tool's first touch is the least arrival over the surface. Only the ring counts, no
// shank or holder. Set-up frame.
template <class A>
concept Approach = requires(const A& approach, const Vec3& s, double x) {
  { approach.arrival(s) } -> std::same_as<double>;
  // Compares arrivals without their cost: order(s) < order_of(x) where arrival(s) < x.
  { approach.order(s) } -> std::same_as<double>;
  { approach.order_of(x) } -> std::same_as<double>;
  { approach.pose(x) } -> std::same_as<ToolPose>;
  // How a surface point moves relative to the tool: ds/dx = velocity(s), d2s/dx2 = acceleration(s); and how
  // the velocity changes along a vector.
  { approach.velocity(s) } -> std::same_as<Vec3>;
  { approach.velocity_change(s) } -> std::same_as<Vec3>;
  { approach.acceleration(s) } -> std::same_as<Vec3>;
};

// Lowering an upright tool over plan point `at` along -z; x = -(height of the torus centre), mm.
//
// Requires: the tool outlives it.
class Drop {
 public:
  Drop(const Tool& tool, const Vec2& at) : tool_(tool), at_(at) {}
  double arrival(const Vec3& s) const { return -drop_height(tool_, at_, s); }
  double order(const Vec3& s) const { return arrival(s); }
  double order_of(double x) const { return x; }
  ToolPose pose(double x) const { return {Vec3(at_.x(), at_.y(), -x), Vec3::UnitZ()}; }
  Vec3 velocity(const Vec3&) const { return Vec3::UnitZ(); }
  Vec3 velocity_change(const Vec3&) const { return Vec3::Zero(); }
  Vec3 acceleration(const Vec3&) const { return Vec3::Zero(); }

 private:
  const Tool& tool_;
  Vec2 at_;
};

// Tilting about the pseudo-insert, far side down; x = tilt, radians.
//
// Requires: tool and insert outlive it; major_radius > 0 (circular_ray).
class Tilt {
 public:
  Tilt(const Tool& tool, const Insert& insert) : tool_(tool), insert_(insert) {}
  double arrival(const Vec3& s) const {
    const double x = circular_ray(tool_, insert_.to_local(s));
    return x == x ? x : kInfinity;
  }
  double order(const Vec3& s) const { return circular_ray_direction(tool_, insert_.to_local(s)).order(); }
  double order_of(double x) const { return TiltDirection{std::cos(x), std::sin(x)}.order(); }
  ToolPose pose(double x) const { return tilted(tool_, insert_, x); }
  Vec3 velocity(const Vec3& s) const { return insert_.u1.cross(s - insert_.center); }
  Vec3 velocity_change(const Vec3& d) const { return insert_.u1.cross(d); }
  Vec3 acceleration(const Vec3& s) const { return insert_.u1.cross(velocity(s)); }
  const Vec3& axis() const { return insert_.u1; }
  const Vec3& center() const { return insert_.center; }

 private:
  const Tool& tool_;
  const Insert& insert_;
};

static_assert(Approach<Drop> && Approach<Tilt>);

// The distance from the major circle at surface point s: its gradient (unit, away from the tool), and its
// Hessian by the two directions that it bends in.
struct RingDistance {
  Vec3 gradient, across, around;    // unit, at right angles; across: in the meridian plane
  double bend_across, bend_around;  // 1/mm
  Vec3 ring_curvature;              // 1/mm: of the circle round the tool's axis through s, along `around`
  // The Hessian's products with a vector along the three directions.
  struct Slope {
    double gradient, across, around;
  };
  Slope along(const Vec3& d) const {
    return {gradient.dot(d), bend_across * across.dot(d), bend_around * around.dot(d)};
  }
  // y' H x for Hx = along(x) (its second and third part).
  double bend(const Slope& x, const Vec3& y) const {
    return x.across * across.dot(y) + x.around * around.dot(y);
  }
};
// Requires: s is not on the major circle, where the gradient is 0/0. On the tool's axis any direction serves
//   for that from the axis, and nothing bends round it.
RingDistance ring_distance(const Tool& tool, const ToolPose& pose, const Vec3& s);

// Derivatives of the arrival x at `p`.
//
// Method: the implicit function theorem on distance(s(u, v), pose(x)) = 0.
// Requires: x = approach.arrival(p.s), finite.
// Fails: gradient and Hessian stay NaN where the point does not come nearer to the ring with x: a tangent.
template <Approach A>
Derivatives arrival_derivatives(const Tool& tool, const A& approach, const SurfacePoint& p, double x) {
  Derivatives a;
  a.value = x;
  const RingDistance d = ring_distance(tool, approach.pose(x), p.s);
  const Vec3 w = approach.velocity(p.s);
  const RingDistance::Slope u = d.along(p.su), v = d.along(p.sv), x_slope = d.along(w);
  const double dx = x_slope.gradient;
  if (!(dx < 0)) return a;
  a.gap_rate = -dx;
  a.ring_tangent = d.around, a.ring_curvature = d.ring_curvature;
  const double dux = d.bend(u, w) + d.gradient.dot(approach.velocity_change(p.su));
  const double dvx = d.bend(v, w) + d.gradient.dot(approach.velocity_change(p.sv));
  const double dxx = d.bend(x_slope, w) + d.gradient.dot(approach.acceleration(p.s));
  const double xu = -u.gradient / dx, xv = -v.gradient / dx;
  a.gradient = {xu, xv};
  a.hessian(0, 0) = -(d.bend(u, p.su) + d.gradient.dot(p.suu) + 2 * dux * xu + dxx * xu * xu) / dx;
  a.hessian(1, 1) = -(d.bend(v, p.sv) + d.gradient.dot(p.svv) + 2 * dvx * xv + dxx * xv * xv) / dx;
  a.hessian(0, 1) = a.hessian(1, 0) =
      -(d.bend(u, p.sv) + d.gradient.dot(p.suv) + dux * xv + dvx * xu + dxx * xu * xv) / dx;
  return a;
}

}  // namespace mpm
