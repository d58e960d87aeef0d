#include "mpm/contact/first_arrival.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr int kMaxSteps = 60;     // Newton steps on one patch
constexpr int kMaxHalvings = 40;  // of one step
constexpr int kMaxPatches = 64;   // patches crossed
constexpr double kParallel =
    1e-11;                      // slope of the gap along the surface at which a contact counts as tangent
constexpr double kHeld = 1e-8;  // slope above which a border contact is held by the border
constexpr int kGoldenSteps = 60;
constexpr double kGolden = 0.6180339887498949;

struct Free {
  bool u, v;
};

// Which parameters may move: not into a border whose outside is downhill.
Free free_parameters(const ParamBox& box, double u, double v, const Vec2& gradient) {
  return {!((u <= box.u0 && gradient.x() > 0) || (u >= box.u1 && gradient.x() < 0)),
          !((v <= box.v0 && gradient.y() > 0) || (v >= box.v1 && gradient.y() < 0))};
}

// Newton's step on the free parameters, made a descent step where the arrival is not convex.
Vec2 descent_step(const ArrivalDerivatives& a, Free free) {
  const Vec2& g = a.gradient;
  Vec2 step = Vec2::Zero();
  if (free.u && free.v) {
    const double huu = a.hessian(0, 0), huv = a.hessian(0, 1), hvv = a.hessian(1, 1);
    const double mean = 0.5 * (huu + hvv), spread = std::hypot(0.5 * (huu - hvv), huv);
    // Eigenvalues mean +- spread; the lesser is lifted to a positive fraction of the greater curvature.
    const double least = mean - spread, most = std::max(std::abs(mean) + spread, kRoundoff);
    const double shift = least > 1e-9 * most ? 0.0 : 1e-3 * most - least;
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

// Slope of the gap along the surface in the free directions (dimensionless: mm of gap a mm of surface).
double free_slope(const ArrivalDerivatives& a, const SurfacePoint& p, Free free, double rate) {
  const auto along = [&](bool is_free, double g, const Vec3& tangent) {
    const double length = tangent.norm();
    return is_free && length > 0 ? std::abs(g) * rate / length : 0.0;
  };
  return std::max(along(free.u, a.gradient.x(), p.su), along(free.v, a.gradient.y(), p.sv));
}

template <class Approach>
class PatchSearch {
 public:
  PatchSearch(const Tool& tool, const Approach& approach, const BezierPatch& patch)
      : tool_(tool), approach_(approach), patch_(patch), box_(patch.box()) {}

  // Runs from (u, v) inside the patch.
  Arrival run(double u, double v) {
    Arrival best;
    best.u = std::clamp(u, box_.u0, box_.u1);
    best.v = std::clamp(v, box_.v0, box_.v1);
    SurfacePoint p = patch_.evaluate(best.u, best.v);
    best.s = p.s;
    best.x = approach_.arrival(p.s);
    for (; best.newton_steps < kMaxSteps && best.x < kInfinity; ++best.newton_steps) {
      const ArrivalDerivatives a = arrival_derivatives(tool_, approach_, p);
      if (!a.gradient.allFinite() || !a.hessian.allFinite()) break;
      const double rate =
          -ring_distance(tool_, approach_.pose(best.x), p.s).gradient.dot(approach_.velocity(p.s));
      const Free free = free_parameters(box_, best.u, best.v, a.gradient);
      mark_borders(best, a, p, free, rate);
      if (free_slope(a, p, free, rate) <= kParallel) break;
      if (!advance(best, p, bounded_step(best, a, free))) break;
    }
    return best;
  }

 private:
  void mark_borders(
      Arrival& best, const ArrivalDerivatives& a, const SurfacePoint& p, Free free, double rate) const {
    best.on_border_u = !free.u && std::abs(a.gradient.x()) * rate > kHeld * p.su.norm();
    best.on_border_v = !free.v && std::abs(a.gradient.y()) * rate > kHeld * p.sv.norm();
  }

  // Newton's step shortened to end on the border it would cross; one that would leave at once slides along
  // the border.
  Vec2 bounded_step(const Arrival& at, const ArrivalDerivatives& a, Free free) const {
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

  // Halves the step until the arrival is earlier; false when no step is.
  bool advance(Arrival& best, SurfacePoint& p, Vec2 step) const {
    for (int k = 0; k < kMaxHalvings; ++k, step *= 0.5) {
      const double u = std::clamp(best.u + step.x(), box_.u0, box_.u1);
      const double v = std::clamp(best.v + step.y(), box_.v0, box_.v1);
      if (u == best.u && v == best.v) return false;
      const SurfacePoint q = patch_.evaluate(u, v);
      const double x = approach_.arrival(q.s);
      if (x < best.x || (k == 0 && x == best.x)) {
        best.x = x, best.u = u, best.v = v, best.s = q.s;
        p = q;
        return true;
      }
    }
    return false;
  }

  const Tool& tool_;
  const Approach& approach_;
  const BezierPatch& patch_;
  ParamBox box_;
};

// A point just beyond the border that holds the arrival, in the neighbouring patch; or the same point on a
// face's edge.
Vec2 across_border(const Arrival& at, const ParamBox& patch, const ParamBox& domain) {
  const auto beyond = [](double t, double lo, double hi, double d0, double d1) {
    if (t <= lo && lo > d0) return std::nextafter(lo, d0);
    if (t >= hi && hi < d1) return hi;  // at a break the patch after it is found
    return t;
  };
  return {at.on_border_u ? beyond(at.u, patch.u0, patch.u1, domain.u0, domain.u1) : at.u,
          at.on_border_v ? beyond(at.v, patch.v0, patch.v1, domain.v0, domain.v1) : at.v};
}

// Least arrival along the trimming polygon that passes nearest to (u, v), downhill from there.
template <class Approach>
Arrival along_trim(const Approach& approach, const Face& face, double u, double v) {
  const auto at = [&](const Vec2& uv) { return approach.arrival(face.surface.point(uv.x(), uv.y())); };
  const std::vector<Vec2>* loop = nullptr;
  std::size_t nearest = 0;
  double least = kInfinity;
  for (const auto& one : face.trim.loops())
    for (std::size_t i = 0; i < one.size(); ++i) {
      const Vec2& a = one[i];
      const Vec2 d = one[(i + 1) % one.size()] - a;
      const double t =
          d.squaredNorm() > 0 ? std::clamp((Vec2(u, v) - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
      const double distance = (a + t * d - Vec2(u, v)).squaredNorm();
      if (distance < least) least = distance, loop = &one, nearest = i;
    }
  const std::size_t n = loop->size();
  const auto vertex = [&](std::size_t i) { return (*loop)[i % n]; };
  // Walk to the lowest vertex, then search the two edges at it.
  std::size_t i = at(vertex(nearest)) <= at(vertex(nearest + 1)) ? nearest : (nearest + 1) % n;
  for (std::size_t count = 0; count < n; ++count) {
    const double here = at(vertex(i)), next = at(vertex(i + 1)), before = at(vertex(i + n - 1));
    if (std::min(next, before) >= here) break;
    i = next < before ? (i + 1) % n : (i + n - 1) % n;
  }
  Arrival best;
  const auto consider = [&](const Vec2& uv) {
    const double x = at(uv);
    if (x < best.x) best.x = x, best.u = uv.x(), best.v = uv.y();
  };
  for (const Vec2& other : {vertex(i + 1), vertex(i + n - 1)}) {
    double lo = 0, hi = 1;
    for (int k = 0; k < kGoldenSteps; ++k) {
      const double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
      const Vec2 pa = vertex(i) + a * (other - vertex(i)), pb = vertex(i) + b * (other - vertex(i));
      (at(pa) <= at(pb) ? hi : lo) = at(pa) <= at(pb) ? b : a;
    }
    consider(vertex(i) + 0.5 * (lo + hi) * (other - vertex(i)));
  }
  consider(vertex(i));
  if (best.x < kInfinity) best.s = face.surface.point(best.u, best.v);
  best.on_border_u = best.on_border_v = true;
  return best;
}

}  // namespace

template <class Approach>
Arrival first_arrival(const Tool& tool, const Approach& approach, const Face& face, double u, double v) {
  const BezierPatch* patch = &face.surface.patch_at(u, v);
  Arrival best = PatchSearch<Approach>(tool, approach, *patch).run(u, v);
  int steps = best.newton_steps;
  for (int k = 0; k < kMaxPatches && (best.on_border_u || best.on_border_v); ++k) {
    const Vec2 beyond = across_border(best, patch->box(), face.surface.domain());
    const BezierPatch* neighbour = &face.surface.patch_at(beyond.x(), beyond.y());
    if (neighbour == patch) break;
    const Arrival there = PatchSearch<Approach>(tool, approach, *neighbour).run(beyond.x(), beyond.y());
    steps += there.newton_steps;
    if (!(there.x < best.x)) break;  // a crease holds the contact
    best = there;
    patch = neighbour;
  }
  best.newton_steps = steps;
  if (!face.trim.everything() && !(best.x < kInfinity && face.trim.contains(best.u, best.v)))
    best = along_trim(approach, face, u, v);
  return best;
}

template Arrival first_arrival(const Tool&, const Drop&, const Face&, double, double);
template Arrival first_arrival(const Tool&, const Tilt&, const Face&, double, double);

}  // namespace mpm
