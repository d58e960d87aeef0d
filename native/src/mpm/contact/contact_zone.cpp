#include "mpm/contact/contact_zone.h"

#include <algorithm>
#include <cmath>

#include "mpm/contact/approach.h"

namespace mpm {
namespace {

constexpr double kZoneSizes[kLanes] = {0.1, 0.04, 0.015, 0.005};  // half-lengths against the cutter's radius
// Half-width against that at which the gap is as great as at the ends; and against the bulge of the ring.
constexpr double kLeastWidth = 0.6;
constexpr double kWidth = 2, kBendWidth = 6;

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

// Directions in (u, v): `along` the valley in which the gap is least for its length, `across` it 1 mm long on
// the surface; conjugate with respect to the gap's Hessian.
struct Directions {
  Vec2 along, across;
  double bend_along, bend_across;  // half the gap's second derivative, 1/mm
};

Directions tangent_directions(const SurfacePoint& p, const ToolPose& pose, const Eigen::Matrix2d& hessian) {
  const Vec3 normal = p.su.cross(p.sv).normalized();
  Vec3 ring = pose.axis.cross(p.s - pose.torus_center);
  ring = (ring - ring.dot(normal) * normal).normalized();
  Eigen::Matrix<double, 3, 2> jacobian, wanted;
  jacobian << p.su, p.sv;
  wanted << ring, normal.cross(ring);
  const Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
  const Eigen::Matrix2d w = metric.inverse() * (jacobian.transpose() * wanted);
  const Eigen::Matrix2d bend = 0.5 * w.transpose() * hessian * w;
  const double drift = -bend(0, 1) / bend(1, 1);
  return {w.col(0) + drift * w.col(1), w.col(1), bend(0, 0) + drift * bend(0, 1), bend(1, 1)};
}

double part_of(const BezierPatch& patch, const Vec2& w) {
  const ParamBox& box = patch.box();
  return 2 * std::max(std::abs(w.x()) / (box.u1 - box.u0), std::abs(w.y()) / (box.v1 - box.v0));
}

// The surface round `p` over the parallelogram p + a w1 + b w2, by Taylor's formula. `third` bounds the third
// derivative over the whole patch.
QuadraticCell zone_cell(
    const SurfacePoint& p, const BezierPatch& patch, double third, const Vec2& w1, const Vec2& w2) {
  const auto second = [&](const Vec2& a, const Vec2& b) -> Vec3 {
    return a.x() * b.x() * p.suu + (a.x() * b.y() + a.y() * b.x()) * p.suv + a.y() * b.y() * p.svv;
  };
  const double part = part_of(patch, w1) + part_of(patch, w2);
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

// Whether the quadratic without its first-order terms is nowhere negative on the square, the terms of third
// order taken off the squares.
bool convex(const RingQuadratic& q, int lane) {
  const double loss = q.loss[lane] + (std::abs(q.g1[lane]) + std::abs(q.g2[lane])) * q.shift[lane];
  const double a = q.h11[lane] - std::abs(q.aaa[lane]) - std::abs(q.aab[lane]) - loss;
  const double b = q.h22[lane] - std::abs(q.abb[lane]) - std::abs(q.bbb[lane]) - loss;
  return q.f[lane] == q.f[lane] && a > 0 && b > 0 && 4 * a * b > q.h12[lane] * q.h12[lane];
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
  const Derivatives gap = GapObjective(tool, pose).derivatives(p, lowest.value);
  const Directions d = tangent_directions(p, pose, gap.hessian);
  const double r = (p.s - pose.torus_center).cross(pose.axis).norm();
  if (!(d.bend_along > 0) || !(d.bend_across > 0) || !d.along.allFinite()) return std::nullopt;
  const auto along = [&](int lane) -> Vec2 { return kZoneSizes[lane] * tool.radius() * d.along; };
  const auto across = [&](int lane) -> Vec2 {
    const double size = kZoneSizes[lane] * tool.radius();
    const double width =
        std::max({kWidth * std::sqrt(d.bend_along / d.bend_across), kBendWidth * size / r, kLeastWidth});
    return size * width * d.across;
  };
  CellBatch cells;
  for (int lane = 0; lane < kLanes; ++lane)
    put_lane(cells, lane, zone_cell(p, patch, third, along(lane), across(lane)));
  RingQuadratic q;
  bound.quadratic(cells, q);
  for (int lane = 0; lane < kLanes; ++lane) {
    if (!convex(q, lane)) continue;
    const Vec2 w1 = along(lane), w2 = across(lane);
    // A border that holds the contact lets the gap only grow inwards; elsewhere the slope is rounding.
    double lower = lowest.value - bound.rounding();
    if (!lowest.on_border_u) lower -= std::abs(gap.gradient.x()) * (std::abs(w1.x()) + std::abs(w2.x()));
    if (!lowest.on_border_v) lower -= std::abs(gap.gradient.y()) * (std::abs(w1.y()) + std::abs(w2.y()));
    lower = std::min(lower, bound.pieces(get_lane(cells, lane), lower).lower);
    if (lower < lowest.value - tool.radius()) return std::nullopt;
    Eigen::Matrix2d w;
    w << w1, w2;
    return ContactZone{&patch, {lowest.u, lowest.v}, w.inverse(), lower};
  }
  return std::nullopt;
}

}  // namespace mpm
