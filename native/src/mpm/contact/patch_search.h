// Newton's iteration for a minimum over one Bézier patch, with exact derivatives and borders.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/surface/bezier_patch.h"

namespace mpm {

// Value, gradient and Hessian of an objective with respect to the surface parameters. `gap_rate` turns the
// objective's slope into the slope of the gap between tool and surface (mm of gap a unit of the objective).
struct Derivatives {
  double value = kNaN;
  Vec2 gradient = Vec2::Constant(kNaN);
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Constant(kNaN);
  double gap_rate = 1;
  // The circle of the ring through the point: its unit tangent and its curvature (1/mm).
  Vec3 ring_tangent = Vec3::Zero(), ring_curvature = Vec3::Zero();
  bool usable() const { return gradient.allFinite() && hessian.allFinite(); }
};

struct PatchMinimum {
  double value = kInfinity;
  double u = kNaN, v = kNaN;
  Vec3 s = Vec3::Constant(kNaN);
  // Held by the border u = const (v = const): not a critical point.
  bool on_border_u = false, on_border_v = false;
  int newton_steps = 0;
};

inline constexpr int kMaxNewtonSteps = 60;  // on one patch
inline constexpr int kMaxHalvings = 40;     // of one step
// A contact counts as found when the slope of the gap along the surface is this little and Newton's step
// promises to gain no more than so much (mm or rad): what rounding leaves at the coordinates of a part, hence
// no part of the tool.
inline constexpr double kParallel = 1e-12;
inline constexpr double kGained = 1e-13;
// Steps that promise less than kGained are judged by the slope alone, the values being equal to rounding: so
// many are taken.
inline constexpr int kPolishingSteps = 2;
inline constexpr double kHeld = 1e-8;  // slope above which a border contact is held by the border
// The least eigenvalue, as part of the greatest, that Newton's step trusts, and what it is lifted to else.
inline constexpr double kConvexPart = 1e-9, kLiftedPart = 1e-3;

struct FreeParameters {
  bool u, v;
};

// Which parameters may move: not into a border whose outside is downhill.
inline FreeParameters free_parameters(const ParamBox& box, double u, double v, const Vec2& gradient) {
  return {!((u <= box.u0 && gradient.x() > 0) || (u >= box.u1 && gradient.x() < 0)),
          !((v <= box.v0 && gradient.y() > 0) || (v >= box.v1 && gradient.y() < 0))};
}

// Newton's step on the free parameters, made a descent step where the arrival is not convex.
inline Vec2 descent_step(const Derivatives& a, FreeParameters free) {
  const Vec2& g = a.gradient;
  Vec2 step = Vec2::Zero();
  if (free.u && free.v) {
    const double huu = a.hessian(0, 0), huv = a.hessian(0, 1), hvv = a.hessian(1, 1);
    const double mean = 0.5 * (huu + hvv), spread = hypotenuse(0.5 * (huu - hvv), huv);
    // Eigenvalues mean +- spread; the lesser is lifted to a positive fraction of the greater curvature.
    const double least = mean - spread, most = std::max(std::abs(mean) + spread, kRoundoff);
    const double shift = least > kConvexPart * most ? 0.0 : kLiftedPart * most - least;
    const double det = (huu + shift) * (hvv + shift) - huv * huv;
    step = {-((hvv + shift) * g.x() - huv * g.y()) / det, -((huu + shift) * g.y() - huv * g.x()) / det};
  } else if (free.u) {
    step.x() =
        a.hessian(0, 0) > 0 ? -g.x() / a.hessian(0, 0) : -g.x() / std::max(-a.hessian(0, 0), std::abs(g.x()));
  } else if (free.v) {
    step.y() =
        a.hessian(1, 1) > 0 ? -g.y() / a.hessian(1, 1) : -g.y() / std::max(-a.hessian(1, 1), std::abs(g.y()));
  }
  return step;
}

inline bool is_convex(const Derivatives& a, FreeParameters free) {
  const bool u = !free.u || a.hessian(0, 0) > 0, v = !free.v || a.hessian(1, 1) > 0;
  return u && v && (!free.u || !free.v || a.hessian.determinant() > 0);
}

// Slope of the gap along the surface in the free directions (dimensionless: mm of gap a mm of surface).
inline double free_slope(const Derivatives& a, const SurfacePoint& p, FreeParameters free) {
  const auto along = [&](bool is_free, double g, const Vec3& tangent) {
    const double length = tangent.norm();
    return is_free && length > 0 ? std::abs(g) * a.gap_rate / length : 0.0;
  };
  return std::max(along(free.u, a.gradient.x(), p.su), along(free.v, a.gradient.y(), p.sv));
}

// The valley in which the ring comes near a surface follows the ring, and a long step along it has to bend
// with it: what is to be added to `step`, of second order, for its end to lie on the ring's circle through
// `p`.
inline Vec2 ring_bend(const Derivatives& a, const SurfacePoint& p, const Vec2& step) {
  const double along = a.ring_tangent.dot(step.x() * p.su + step.y() * p.sv);
  const Vec3 bend = 0.5 * along * along * a.ring_curvature -
                    0.5 * (step.x() * step.x() * p.suu + step.y() * step.y() * p.svv) -
                    step.x() * step.y() * p.suv;
  const double uu = p.su.squaredNorm(), uv = p.su.dot(p.sv), vv = p.sv.squaredNorm();
  const double det = uu * vv - uv * uv, bu = bend.dot(p.su), bv = bend.dot(p.sv);
  const Vec2 result((vv * bu - uv * bv) / det, (uu * bv - uv * bu) / det);
  // A step so long that its bend is no smaller says nothing of the ring any more.
  return result.squaredNorm() < step.squaredNorm() ? result : Vec2::Zero();
}

// Minimises `objective` over a patch. An Objective has
//   double value(const Vec3& s) const                                   (+infinity where it has none)
//   Derivatives derivatives(const SurfacePoint& p, double value) const
//
// Requires: objective and patch outlive it.
// Guarantees: what it finds is in the patch, borders included.
// Fails: an infinite value where the start has none; a minimum that is not found in kMaxNewtonSteps is left
//   at the best point so far. A local minimum: nothing is proven of others.
template <class Objective>
class PatchSearch {
 public:
  PatchSearch(const Objective& objective, const BezierPatch& patch)
      : objective_(objective), patch_(patch), box_(patch.box()) {}

  // Runs from (u, v), taken into the patch; the result's value is never greater than the start's
  // but for kGained a polishing step. Where the objective is convex and twice what a step promises leads to
  // no value under `floor`, the search ends there and then.
  PatchMinimum run(double u, double v, double floor = kInfinity) const {
    PatchMinimum best;
    best.u = std::clamp(u, box_.u0, box_.u1);
    best.v = std::clamp(v, box_.v0, box_.v1);
    SurfacePoint p = patch_.evaluate(best.u, best.v);
    best.s = p.s;
    best.value = objective_.value(p.s);
    int polished = 0;
    for (; best.newton_steps < kMaxNewtonSteps && best.value < kInfinity; ++best.newton_steps) {
      const Derivatives a = objective_.derivatives(p, best.value);
      if (!a.usable()) break;
      const FreeParameters free = free_parameters(box_, best.u, best.v, a.gradient);
      best.on_border_u = !free.u && std::abs(a.gradient.x()) * a.gap_rate > kHeld * p.su.norm();
      best.on_border_v = !free.v && std::abs(a.gradient.y()) * a.gap_rate > kHeld * p.sv.norm();
      if (best.value + a.gradient.dot(descent_step(a, free)) > floor && is_convex(a, free)) break;
      const Vec2 step = bounded_step(best, a, free);
      if (free_slope(a, p, free) <= kParallel && std::abs(a.gradient.dot(step)) <= kGained) break;
      if (std::abs(a.gradient.dot(step)) > kGained) {
        const Vec2 bend = free.u && free.v ? ring_bend(a, p, step) : Vec2::Zero();
        if (!advance(best, p, step, bend)) break;
      } else if (polished++ == kPolishingSteps || !polish(best, p, step)) {
        break;
      }
    }
    return best;
  }

 private:
  // Newton's step shortened to end on the border it would cross; one that would leave at once slides along
  // the border.
  Vec2 bounded_step(const PatchMinimum& at, const Derivatives& a, FreeParameters free) const {
    Vec2 step = descent_step(a, free);
    const bool leaves_u = (at.u <= box_.u0 && step.x() < 0) || (at.u >= box_.u1 && step.x() > 0);
    const bool leaves_v = (at.v <= box_.v0 && step.y() < 0) || (at.v >= box_.v1 && step.y() > 0);
    if (leaves_u || leaves_v) step = descent_step(a, {free.u && !leaves_u, free.v && !leaves_v});
    double part = 1.0;
    const auto shorten = [&](double t, double d, double lo, double hi) {
      if (t + d < lo) part = std::min(part, (lo - t) / d);
      if (t + d > hi) part = std::min(part, (hi - t) / d);
    };
    shorten(at.u, step.x(), box_.u0, box_.u1);
    shorten(at.v, step.y(), box_.v0, box_.v1);
    return part * step;
  }

  // Takes the step unless it makes the value worse by more than rounding.
  bool polish(PatchMinimum& best, SurfacePoint& p, const Vec2& step) const {
    const double u = std::clamp(best.u + step.x(), box_.u0, box_.u1);
    const double v = std::clamp(best.v + step.y(), box_.v0, box_.v1);
    const SurfacePoint q = patch_.evaluate(u, v);
    const double value = objective_.value(q.s);
    if (!(value <= best.value + kGained)) return false;
    best.value = value, best.u = u, best.v = v, best.s = q.s;
    p = q;
    return true;
  }

  // Halves the step until the value is less; false when no step is. What the step is bent by shrinks as its
  // square.
  bool advance(PatchMinimum& best, SurfacePoint& p, Vec2 step, Vec2 bend) const {
    for (int k = 0; k < kMaxHalvings; ++k, step *= 0.5, bend *= 0.25) {
      const double u = std::clamp(best.u + step.x() + bend.x(), box_.u0, box_.u1);
      const double v = std::clamp(best.v + step.y() + bend.y(), box_.v0, box_.v1);
      if (u == best.u && v == best.v) return false;
      const SurfacePoint q = patch_.evaluate(u, v);
      const double value = objective_.value(q.s);
      if (value < best.value || (k == 0 && value == best.value)) {
        best.value = value, best.u = u, best.v = v, best.s = q.s;
        p = q;
        return true;
      }
    }
    return false;
  }

  const Objective& objective_;
  const BezierPatch& patch_;
  ParamBox box_;
};

}  // namespace mpm
