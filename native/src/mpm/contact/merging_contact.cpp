#include "mpm/contact/merging_contact.h"

#include <cmath>

namespace mpm {
namespace {

constexpr double kReach = 1.0 / 16;  // cutter radii from P to the two points of the valley
constexpr double kFarthest = 3;      // reaches: how far the parabola is believed
constexpr int kAcrossSteps = 4;      // Newton's, onto the valley
constexpr double kOnValley = 1e-6;   // cutter radii: a step shorter than this is the last
constexpr double kNoGain = 1e-11;    // radians: a minimum this little under the limit is P itself

struct ValleyPoint {
  Vec2 at;
  double arrival = kInfinity;
};

class Valley {
 public:
  Valley(const Tool& tool, const Tilt& approach, const Face& face, const PatchMinimum& first)
      : tool_(tool), approach_(approach), face_(face), first_(first.u, first.v) {
    const SurfacePoint p = face.surface.evaluate(first.u, first.v);
    on_border_ = first.on_border_u || first.on_border_v;
    if (on_border_) {
      // Along the border that holds P, one millimetre.
      directions_.setZero();
      if (!first.on_border_u) directions_(0, 0) = 1 / p.su.norm();
      if (!first.on_border_v) directions_(1, 0) = 1 / p.sv.norm();
      return;
    }
    const Vec3 normal = (approach.center() - p.s).normalized(), across = normal.cross(approach.axis());
    Eigen::Matrix<double, 3, 2> jacobian, wanted;
    jacobian << p.su, p.sv;
    wanted << approach.axis(), across;
    const Eigen::Matrix2d metric = jacobian.transpose() * jacobian;
    directions_ = metric.inverse() * (jacobian.transpose() * wanted);
    // The gap's second-order form at P: where it is least across, for a step along.
    const auto bending = [&](const Vec2& a, const Vec2& b) {
      const Vec3 second =
          a.x() * b.x() * p.suu + (a.x() * b.y() + a.y() * b.x()) * p.suv + a.y() * b.y() * p.svv;
      return normal.dot(second);
    };
    const Vec2 u = directions_.col(0), v = directions_.col(1);
    drift_ = bending(u, v) / (1 / tool.minor_radius - bending(v, v));
  }

  bool usable() const {
    return directions_.allFinite() && !directions_.col(0).isZero(0) && std::isfinite(drift_);
  }

  // The point of the valley `along` mm from P; no arrival where it leaves the face.
  ValleyPoint at(double along) const {
    double across = drift_ * along;
    ValleyPoint point;
    for (int k = 0; k < kAcrossSteps; ++k) {
      point.at = first_ + directions_ * Vec2(along, across);
      if (!inside(point.at)) return {};
      const SurfacePoint p = face_.surface.evaluate(point.at.x(), point.at.y());
      point.arrival = approach_.arrival(p.s);
      if (!(point.arrival < kInfinity)) return {};
      if (on_border_) break;
      const Derivatives a = arrival_derivatives(tool_, approach_, p, point.arrival);
      const Vec2 v = directions_.col(1);
      const double slope = a.gradient.dot(v), bend = v.dot(a.hessian * v);
      if (!(bend > 0)) return {};
      const double step = slope / bend;
      if (std::abs(step) < kOnValley * tool_.radius()) break;
      across -= step;
    }
    return point;
  }

 private:
  bool inside(const Vec2& uv) const {
    const ParamBox& d = face_.surface.domain();
    return uv.x() >= d.u0 && uv.x() <= d.u1 && uv.y() >= d.v0 && uv.y() <= d.v1;
  }

  const Tool& tool_;
  const Tilt& approach_;
  const Face& face_;
  Vec2 first_;
  Eigen::Matrix2d directions_;  // parameters a mm along the ring and across it
  double drift_ = 0;            // mm across a mm along
  bool on_border_;
};

}  // namespace

std::optional<Vec2> merging_contact(const Tool& tool,
                                    const Tilt& approach,
                                    const Face& face,
                                    const PatchMinimum& first_contact,
                                    double curvature) {
  const Valley valley(tool, approach, face, first_contact);
  if (!valley.usable()) return std::nullopt;
  const double h = kReach * tool.radius();
  const ValleyPoint before = valley.at(-h), after = valley.at(h);
  const double least = std::min(before.arrival, after.arrival);
  if (!(least < kInfinity)) return std::nullopt;
  if (!(before.arrival < kInfinity) || !(after.arrival < kInfinity))
    return least < curvature ? std::optional(before.arrival < after.arrival ? before.at : after.at)
                             : std::nullopt;
  const double slope = (after.arrival - before.arrival) / (2 * h);
  const double bend = (after.arrival + before.arrival - 2 * curvature) / (h * h);
  const double farthest = std::copysign(kFarthest * h, -slope);
  const double along = bend > 0 && std::abs(slope) < bend * kFarthest * h ? -slope / bend : farthest;
  if (slope * along + 0.5 * bend * along * along > -kNoGain) return std::nullopt;
  const ValleyPoint start = valley.at(along);
  if (start.arrival < kInfinity) return start.at;
  return least < curvature ? std::optional(before.arrival < after.arrival ? before.at : after.at)
                           : std::nullopt;
}

}  // namespace mpm
