#include "mpm/contact/merging_contact.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kReach = 1.0 / 16;   // cutter radii from P to the two points of the valley
constexpr double kFarthest = 3;       // reaches: how far the parabola is believed
constexpr double kLeastReach = 1e-4;  // cutter radii: a border nearer than this is P's
constexpr int kAcrossSteps = 4;       // Newton's, onto the valley
constexpr double kOnValley = 1e-6;    // cutter radii: a step shorter than this is the last
constexpr double kNoGain = 1e-11;     // radians: a minimum this little under the limit is P itself

struct ValleyPoint {
  Vec2 at;
  double along = 0;  // mm
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

  // The point of the valley `along` mm from P, or where it meets the border of the face on the way; without
  // an arrival where P is on that border.
  ValleyPoint at(double along) const {
    along *= inside_part(directions_ * Vec2(along, drift_ * along));
    if (!(std::abs(along) > kLeastReach * tool_.radius())) return {};
    double across = drift_ * along;
    ValleyPoint point;
    point.along = along;
    for (int k = 0; k < kAcrossSteps; ++k) {
      point.at = into_domain(first_ + directions_ * Vec2(along, across));
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
  // How much of a move from P stays on the face's domain.
  double inside_part(const Vec2& move) const {
    const ParamBox& d = face_.surface.domain();
    double part = 1;
    const auto limit = [&](double t, double dt, double lo, double hi) {
      if (t + dt < lo) part = std::min(part, (lo - t) / dt);
      if (t + dt > hi) part = std::min(part, (hi - t) / dt);
    };
    limit(first_.x(), move.x(), d.u0, d.u1);
    limit(first_.y(), move.y(), d.v0, d.v1);
    return part;
  }

  Vec2 into_domain(const Vec2& uv) const {
    const ParamBox& d = face_.surface.domain();
    return {std::clamp(uv.x(), d.u0, d.u1), std::clamp(uv.y(), d.v0, d.v1)};
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
                                    double curvature,
                                    bool nearby) {
  const Valley valley(tool, approach, face, first_contact);
  if (!valley.usable()) return std::nullopt;
  const double h = kReach * tool.radius();
  const ValleyPoint before = valley.at(-h), after = valley.at(h);
  const double least = std::min(before.arrival, after.arrival);
  if (!(least < kInfinity)) return std::nullopt;
  if (!(before.arrival < kInfinity) || !(after.arrival < kInfinity))
    return least < curvature ? std::optional(before.arrival < after.arrival ? before.at : after.at)
                             : std::nullopt;
  // The parabola through both and P.
  const double forward = (after.arrival - curvature) / after.along,
               backward = (before.arrival - curvature) / before.along;
  const double bend = 2 * (forward - backward) / (after.along - before.along);
  const double slope = forward - 0.5 * bend * after.along;
  if (nearby && !(std::abs(slope) < bend * h)) return std::nullopt;
  const double farthest = std::copysign(kFarthest * h, -slope);
  const double along = bend > 0 && std::abs(slope) < bend * kFarthest * h ? -slope / bend : farthest;
  if (slope * along + 0.5 * bend * along * along > -kNoGain) return std::nullopt;
  const ValleyPoint start = valley.at(along);
  if (start.arrival < kInfinity) return start.at;
  return least < curvature ? std::optional(before.arrival < after.arrival ? before.at : after.at)
                           : std::nullopt;
}

}  // namespace mpm
