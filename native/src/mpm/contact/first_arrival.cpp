#include "mpm/contact/first_arrival.h"

#include "mpm/contact/patch_search.h"

namespace mpm {
namespace {

constexpr int kMaxPatches = 64;  // crossed on the way
constexpr int kGoldenSteps = 60;
constexpr double kGolden = 0.6180339887498949;

template <Approach A>
class ArrivalObjective {
 public:
  ArrivalObjective(const Tool& tool, const A& approach) : tool_(tool), approach_(approach) {}
  double value(const Vec3& s) const { return approach_.arrival(s); }
  Derivatives derivatives(const SurfacePoint& p, double x) const {
    return arrival_derivatives(tool_, approach_, p, x);
  }

 private:
  const Tool& tool_;
  const A& approach_;
};

// A point just beyond the border that holds the arrival, in the neighbouring patch; or the same point on a
// face's edge.
Vec2 across_border(const PatchMinimum& at, const ParamBox& patch, const ParamBox& domain) {
  const auto beyond = [](double t, double lo, double hi, double d0, double d1) {
    if (t <= lo && lo > d0) return std::nextafter(lo, d0);
    if (t >= hi && hi < d1) return hi;  // at a break the patch after it is found
    return t;
  };
  return {at.on_border_u ? beyond(at.u, patch.u0, patch.u1, domain.u0, domain.u1) : at.u,
          at.on_border_v ? beyond(at.v, patch.v0, patch.v1, domain.v0, domain.v1) : at.v};
}

// Least arrival along the trimming polygon that passes nearest to (u, v), downhill from there.
template <Approach A>
PatchMinimum along_trim(const A& approach, const Face& face, double u, double v) {
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
  PatchMinimum best;
  const auto consider = [&](const Vec2& uv) {
    const double x = at(uv);
    if (x < best.value) best.value = x, best.u = uv.x(), best.v = uv.y();
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
  if (best.value < kInfinity) best.s = face.surface.point(best.u, best.v);
  best.on_border_u = best.on_border_v = true;
  return best;
}

}  // namespace

template <Approach A>
PatchMinimum first_arrival(const Tool& tool, const A& approach, const Face& face, double u, double v) {
  const ArrivalObjective<A> objective(tool, approach);
  using Search = PatchSearch<ArrivalObjective<A>>;
  const BezierPatch* patch = &face.surface.patch_at(u, v);
  PatchMinimum best = Search(objective, *patch).run(u, v);
  int steps = best.newton_steps;
  for (int k = 0; k < kMaxPatches && (best.on_border_u || best.on_border_v); ++k) {
    const Vec2 beyond = across_border(best, patch->box(), face.surface.domain());
    const BezierPatch* neighbour = &face.surface.patch_at(beyond.x(), beyond.y());
    if (neighbour == patch) break;
    const PatchMinimum there = Search(objective, *neighbour).run(beyond.x(), beyond.y());
    steps += there.newton_steps;
    if (!(there.value < best.value)) break;  // a crease holds the contact
    best = there;
    patch = neighbour;
  }
  best.newton_steps = steps;
  if (!face.trim.everything() && !(best.value < kInfinity && face.trim.contains(best.u, best.v)))
    best = along_trim(approach, face, u, v);
  return best;
}

template PatchMinimum first_arrival(const Tool&, const Drop&, const Face&, double, double);
template PatchMinimum first_arrival(const Tool&, const Tilt&, const Face&, double, double);

}  // namespace mpm
