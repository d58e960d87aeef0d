#include "mpm/contact/contact_zone.h"

#include <algorithm>
#include <cmath>

#include "mpm/contact/approach.h"

namespace mpm {
namespace {

constexpr double kLargestZone = 1.0 / 12;  // half-width against the cutter's radius
constexpr int kZoneSizes = 4;
constexpr double kZoneShrink = 0.25;  // from one to the next

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
    Derivatives a;
    a.value = value;
    a.gradient = {d.gradient.dot(p.su), d.gradient.dot(p.sv)};
    const Vec3 hu = d.hessian * p.su, hv = d.hessian * p.sv;
    a.hessian(0, 0) = hu.dot(p.su) + d.gradient.dot(p.suu);
    a.hessian(1, 1) = hv.dot(p.sv) + d.gradient.dot(p.svv);
    a.hessian(0, 1) = a.hessian(1, 0) = hu.dot(p.sv) + d.gradient.dot(p.suv);
    return a;
  }

 private:
  const Tool& tool_;
  const ToolPose& pose_;
};

// Directions in (u, v), each 1 mm long on the surface and at right angles there: the ring's tangent and
// across it.
Eigen::Matrix2d tangent_directions(const SurfacePoint& p, const ToolPose& pose) {
  const Vec3 normal = p.su.cross(p.sv);
  const Vec3 radial = p.s - pose.torus_center;
  Vec3 along = pose.axis.cross(radial);
  along -= along.dot(normal) / normal.squaredNorm() * normal;
  const Vec3 first = along.normalized(), second = normal.normalized().cross(first);
  Eigen::Matrix<double, 3, 2> jacobian;
  jacobian << p.su, p.sv;
  Eigen::Matrix<double, 3, 2> wanted;
  wanted << first, second;
  const Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
  return metric.inverse() * (jacobian.transpose() * wanted);
}

// The surface round `p` over the parallelogram p + a w1 + b w2, by Taylor's formula.
QuadraticCell zone_cell(const SurfacePoint& p,
                        const BezierPatch& patch,
                        double third,
                        const Eigen::Matrix2d& w) {
  const auto second = [&](const Vec2& a, const Vec2& b) -> Vec3 {
    return a.x() * b.x() * p.suu + (a.x() * b.y() + a.y() * b.x()) * p.suv + a.y() * b.y() * p.svv;
  };
  const Vec2 w1 = w.col(0), w2 = w.col(1);
  const double half_u = 0.5 * (patch.box().u1 - patch.box().u0),
               half_v = 0.5 * (patch.box().v1 - patch.box().v0);
  const double part = std::max((std::abs(w1.x()) + std::abs(w2.x())) / half_u,
                               (std::abs(w1.y()) + std::abs(w2.y())) / half_v);
  QuadraticCell cell{p.s,
                     w1.x() * p.su + w1.y() * p.sv,
                     w2.x() * p.su + w2.y() * p.sv,
                     0.5 * second(w1, w1),
                     second(w1, w2),
                     0.5 * second(w2, w2),
                     third * part * part * part / 6,
                     0};
  cell.set_radius();
  return cell;
}

bool convex(const QuadraticBound& q) {
  const double a = q.h11 - q.loss, b = q.h22 - q.loss;
  return a > 0 && b > 0 && 4 * a * b > q.h12 * q.h12;
}

}  // namespace

PatchMinimum lowest_point(
    const Tool& tool, const ToolPose& pose, const BezierPatch& patch, double u, double v) {
  const GapObjective objective(tool, pose);
  return PatchSearch<GapObjective>(objective, patch).run(u, v);
}

bool ContactZone::contains(const BezierPatch* of, const ParamBox& box) const {
  if (of != patch) return false;
  for (double u : {box.u0, box.u1})
    for (double v : {box.v0, box.v1})
      if ((to_unit * (Vec2(u, v) - center)).cwiseAbs().maxCoeff() > 1) return false;
  return true;
}

std::optional<ContactZone> contact_zone(const Tool& tool,
                                        const ToolPose& pose,
                                        const ClearanceBound& bound,
                                        const BezierPatch& patch,
                                        double third,
                                        const PatchMinimum& lowest) {
  const SurfacePoint p = patch.evaluate(lowest.u, lowest.v);
  const Eigen::Matrix2d directions = tangent_directions(p, pose);
  if (!directions.allFinite()) return std::nullopt;
  const Derivatives gap = GapObjective(tool, pose).derivatives(p, lowest.value);
  double size = kLargestZone * tool.radius();
  for (int k = 0; k < kZoneSizes; ++k, size *= kZoneShrink) {
    const Eigen::Matrix2d w = size * directions;
    const QuadraticCell cell = zone_cell(p, patch, third, w);
    if ((p.s - pose.torus_center).cross(pose.axis).norm() <= cell.radius) continue;
    if (!convex(bound.ring(cell))) continue;
    // A border that holds the contact lets the gap only grow inwards; elsewhere the slope is rounding.
    double lower = lowest.value - bound.rounding();
    if (!lowest.on_border_u) lower -= std::abs(gap.gradient.x()) * w.row(0).cwiseAbs().sum();
    if (!lowest.on_border_v) lower -= std::abs(gap.gradient.y()) * w.row(1).cwiseAbs().sum();
    lower = std::min(lower, bound.pieces(cell, lower).lower);
    if (lower < lowest.value - tool.radius()) return std::nullopt;
    return ContactZone{&patch, {lowest.u, lowest.v}, w.inverse(), lower};
  }
  return std::nullopt;
}

}  // namespace mpm
