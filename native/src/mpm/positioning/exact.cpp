#include "mpm/positioning/exact.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/base/frame.h"
#include "mpm/contact/curvature_limit.h"
#include "mpm/contact/merging_contact.h"
#include "mpm/gouge/certify_pose.h"
#include "mpm/gouge/judge_cells.h"

namespace mpm {
namespace {

constexpr double kStartPerRadius = 1.0 / 4;  // cells whose centres start the searches
constexpr double kSharpness = 1e-9;          // mm: contacts are found to this depth
constexpr double kSharpRoundoff = 4096 * kRoundoff;
constexpr std::uint32_t kSharpBudget = 4000;  // cells; a ring lying on the surface is not resolved further
constexpr double kGougeTolerance = 1e-3;      // mm
constexpr double kCellBudget = 200'000;
constexpr int kMaxRounds = 64;           // contacts tried before a position is given up
constexpr int kPointRounds = 16;         // of these, in which a point's own arrival may be taken
constexpr double kFirstBackStep = 1e-6;  // mm or rad, doubled until the body is clear
constexpr double kMostBackSteps = 1e3;
constexpr int kBisections = 50;
constexpr double kMerged = 0.02;  // mm: a second contact nearer than this is the first
constexpr double kNearLimit =
    0.01;  // rad: a second contact this close to the curvature limit may have rivals
constexpr double kNoDirection = 1e-9;  // part along the surface that a direction must have
constexpr double kNoTilt = 1e-9;       // rad
constexpr double kNoGain = 1e-8;       // mm or rad: a touch earlier by less than this is the same

struct Start {
  std::uint32_t face;
  double u, v;
  Vec3 s;
};

class Exact final : public Method {
 public:
  Exact(const SurfaceModel& model, const Tool& tool, const MethodOptions& options)
      : model_(model),
        tool_(tool),
        cells_(options.cells ? options.cells : std::make_shared<CellTree>(judge_cells(model, tool))),
        tree_(*cells_),
        tilt_max_(options.tilt_max),
        spin_(options.spin) {
    const Box3& box = model.bounds();
    const double size = std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()) + tool.length();
    judge_.tolerance = options.numbers.at("gouge_mm");
    judge_.budget = std::uint32_t(options.numbers.at("cell_budget"));
    noise_ = kSharpRoundoff * size;
    judge_.sharpness = std::min(std::max(kSharpness, noise_), judge_.tolerance);
    judge_.sharp_budget = std::min(kSharpBudget, judge_.budget / 2);
    judge_.stop_at_violation = true;
  }

  Placement place(const Vec2& at, Counters& counters) const override;
  Placement place(const GivenContact& at, Counters& counters) const override;
  std::unique_ptr<DroppedTool> drop(const Vec2& at, Counters& counters) const override;

 private:
  class Dropped;
  struct Touch {
    std::uint32_t face = 0;
    PatchMinimum at;
    bool body = false;  // with the flat bottom, the flutes, the shank or the holder, not with the ring
    bool found() const { return at.value < kInfinity; }
  };

  // P is never its own second contact: the arrival there is 0/0, and what it tends to is the curvature limit.
  static bool same_contact(const Touch& touch, const Touch& first) {
    return (touch.at.s - first.at.s).norm() < kMerged;
  }

  template <class Near>
  void gather_starts(const Near& near, std::vector<Start>& starts) const;
  template <class Approach>
  Touch best_start(const Approach& approach,
                   const std::vector<Start>& starts,
                   double limit,
                   Counters& counters) const;
  template <class Approach>
  Touch refine(const Approach& approach, std::uint32_t face, double u, double v, Counters& counters) const;
  template <class Approach>
  double body_arrival(const Approach& approach, double x, const Vec3& s) const;
  template <class Approach>
  Certificate first_touch(
      const Approach& approach, const Touch* first, double& x, Touch& touch, Counters& counters) const;
  void look_beside(
      const Tilt& approach, const Touch& first, double curvature, Touch& second, Counters& counters) const;
  void tilt(const Touch& first,
            const Insert& insert,
            double open_side,
            double tilt_max,
            const std::vector<Start>& starts,
            Placement& placement,
            Counters& counters) const;
  void finish(Placement& placement, const Certificate& certificate) const;
  bool drop(const Vec2& at,
            std::vector<Start>& starts,
            Touch& first,
            Placement& placement,
            Counters& counters) const;
  void spin_and_tilt(double spin,
                     const Touch& first,
                     const std::vector<Start>& starts,
                     Placement& placement,
                     Counters& counters) const;

  const SurfaceModel& model_;
  Tool tool_;
  std::shared_ptr<const CellTree> cells_;
  const CellTree& tree_;
  double tilt_max_, spin_;
  double noise_;  // mm: depths down to this are rounding
  CertifyOptions judge_;
};

// Centres of the cells of about a quarter of the cutter's radius that `near(centre, radius)` lets through.
template <class Near>
void Exact::gather_starts(const Near& near, std::vector<Start>& starts) const {
  starts.clear();
  std::vector<std::uint32_t> stack(tree_.roots().begin(), tree_.roots().end());
  while (!stack.empty()) {
    const CellTree::Node& node = tree_.nodes()[stack.back()];
    stack.pop_back();
    if (!near(node.cell.c, node.cell.radius)) continue;
    if (node.children > 0 && node.cell.radius > kStartPerRadius * tool_.radius()) {
      for (std::uint32_t i = 0; i < node.children; ++i) stack.push_back(node.first_child + i);
      continue;
    }
    const double u = node.box.u_mid(), v = node.box.v_mid();
    if (!node.trimmed || model_.faces()[node.face].trim.contains(u, v))
      starts.push_back({node.face, u, v, node.cell.c});
  }
}

template <class Approach>
Exact::Touch Exact::refine(
    const Approach& approach, std::uint32_t face, double u, double v, Counters& counters) const {
  Touch touch{face, first_arrival(tool_, approach, model_.faces()[face], u, v)};
  counters.newton_steps += std::uint64_t(touch.at.newton_steps);
  counters.evaluations += std::uint64_t(touch.at.newton_steps) + 1;
  return touch;
}

// The arrival of the start that arrives first, refined; not found when none arrives before `limit`.
template <class Approach>
Exact::Touch Exact::best_start(const Approach& approach,
                               const std::vector<Start>& starts,
                               double limit,
                               Counters& counters) const {
  const Start* best = nullptr;
  double least = approach.order_of(limit);
  for (const Start& s : starts) {
    const double order = approach.order(s.s);
    if (order < least) least = order, best = &s;
  }
  return best ? refine(approach, best->face, best->u, best->v, counters) : Touch{};
}

// The greatest x' < x at which s is not inside the tool any more, for a point that is inside at x; x when
// none is near.
template <class Approach>
double Exact::body_arrival(const Approach& approach, double x, const Vec3& s) const {
  const auto clear = [&](double at) {
    return signed_distance(tool_, approach.pose(at), s) >= judge_.tolerance / 2;
  };
  double inside = x, step = kFirstBackStep;
  while (!clear(x - step)) {
    inside = x - step;
    step *= 2;
    if (step > kMostBackSteps) return x;
  }
  double outside = x - step;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (inside + outside);
    (clear(middle) ? outside : inside) = middle;
  }
  return outside;
}

// Brings x down to the first touch: the judge looks at the pose at x; where it finds surface inside the tool,
// the first arrival near that point is the next x, until it finds none. The last certificate belongs to the
// pose at x. Where faces meet, their borders differ by what their polygons may, and the nearest arrival may
// be on the wrong one: then the point's own arrival is taken, a few times; what is left is good to half the
// tolerance. So is what touches the rest of the body, at its deepest point each time. `first`: the contact
// that the motion keeps, if it keeps one.
template <class Approach>
Certificate Exact::first_touch(
    const Approach& approach, const Touch* first, double& x, Touch& touch, Counters& counters) const {
  CertifyOptions options = judge_;
  for (int round = 0;; ++round) {
    const Certificate certificate = certify_pose(tree_, tool_, approach.pose(x), options);
    counters.cells += certificate.cells;
    const Witness& w = certificate.witness;
    const bool is_violation = w.distance < -options.sharpness;
    const bool is_dent = w.distance < -noise_ && options.stop_at_violation;
    if (!(is_violation || is_dent) || round == kMaxRounds) return certificate;
    // The budget is one for all rounds.
    if (certificate.cells >= options.budget) return certificate;
    const Touch ring = refine(approach, w.face, w.u, w.v, counters);
    const bool is_other = !(first && same_contact(ring, *first));
    // A depth less than asked for is a long way in x where the contacts are about to merge, and only there.
    if (!is_violation && !(is_other && ring.at.value < x - kNoGain)) return certificate;
    options.budget -= std::uint32_t(certificate.cells);
    if (ring.at.value < x && is_other) {
      x = ring.at.value;
      touch = ring;
      continue;
    }
    const double own = approach.arrival(w.s);
    if (is_other && own < x - kNoGain && round < kPointRounds) {
      x = own;
      touch = ring;  // held by the same border
      touch.at.value = x, touch.at.u = w.u, touch.at.v = w.v, touch.at.s = w.s;
      continue;
    }
    options.stop_at_violation = false;
    options.sharpness = options.tolerance / 2;
    if (w.distance >= -options.sharpness) continue;
    const double body = body_arrival(approach, x, w.s);
    if (!(body < x)) continue;
    x = body;
    touch = {w.face, {}, true};
    touch.at.value = x, touch.at.u = w.u, touch.at.v = w.v, touch.at.s = w.s;
  }
}

void Exact::finish(Placement& placement, const Certificate& certificate) const {
  placement.clearance_lo = certificate.lo;
  // The contacts are points of the surface, whether the judge met them or not.
  placement.clearance_hi = certificate.hi;
  for (const Vec3& contact : {placement.first_contact, placement.second_contact})
    if (contact.allFinite())
      placement.clearance_hi =
          std::min(placement.clearance_hi, signed_distance(tool_, placement.pose, contact));
  // What the tool cannot reach without cutting in (holder in the way, budget spent) is no place to cut.
  if (certificate.verdict != Verdict::free) placement.status = PositionStatus::undecided;
}

// A second contact that is about to merge with the first comes only a little before the curvature limit, and
// no start's own arrival need lead to it.
void Exact::look_beside(
    const Tilt& approach, const Touch& first, double curvature, Touch& second, Counters& counters) const {
  const Face& face = model_.faces()[first.face];
  const auto start = merging_contact(tool_, approach, face, first.at, curvature, second.found());
  if (!start) return;
  const Touch touch = refine(approach, first.face, start->x(), start->y(), counters);
  if (touch.at.value < second.at.value && !same_contact(touch, first)) second = touch;
}

// Comes down from the curvature limit or `tilt_max` to the first touch; the range ends at `open_side`.
void Exact::tilt(const Touch& first,
                 const Insert& insert,
                 double open_side,
                 double tilt_max,
                 const std::vector<Start>& starts,
                 Placement& placement,
                 Counters& counters) const {
  const SurfacePoint p = model_.faces()[first.face].surface.evaluate(first.at.u, first.at.v);
  const double curvature = curvature_limit(tool_, insert, p, first.at);
  const double limit = std::max(open_side, std::min(curvature, tilt_max));
  const Tilt approach(tool_, insert);
  double x = limit;
  Touch second = best_start(approach, starts, x, counters);
  if (second.found() && same_contact(second, first)) second = {};
  if (curvature <= tilt_max && !(second.at.value < curvature - kNearLimit))
    look_beside(approach, first, curvature, second, counters);
  if (second.found() && second.at.value < x)
    x = second.at.value;
  else
    second = {};
  const Certificate certificate = first_touch(approach, &first, x, second, counters);

  const bool merged = second.found() && same_contact(second, first);
  const bool held = first.at.on_border_u || first.at.on_border_v;
  placement.tilt = std::max(x, open_side);
  placement.pose = tilted(tool_, insert, placement.tilt);
  if (second.found() && !merged && x > open_side + kNoTilt)
    placement.status = PositionStatus::two_contacts;
  else if (x <= open_side + kNoTilt)
    placement.status = PositionStatus::bridged;
  else if (merged || curvature <= tilt_max)
    placement.status = PositionStatus::curvature_matched;
  else
    placement.status = held ? PositionStatus::edge_contact : PositionStatus::tilt_limited;
  if (second.found() && !merged) {
    placement.second_contact = second.at.s;
    if (!second.body) placement.second_normal = -ring_distance(tool_, placement.pose, second.at.s).gradient;
  }
  finish(placement, certificate);
}

// Fills placement with the upright tool and `first` with P; false when nothing can be tilted about it, and
// the placement is all there is.
bool Exact::drop(const Vec2& at,
                 std::vector<Start>& starts,
                 Touch& first,
                 Placement& placement,
                 Counters& counters) const {
  gather_starts(
      [&](const Vec3& c, double radius) {
        return (c.head<2>() - at).squaredNorm() <= (tool_.radius() + radius) * (tool_.radius() + radius);
      },
      starts);
  placement.status = PositionStatus::off_part;
  const Drop approach(tool_, at);
  first = best_start(approach, starts, kInfinity, counters);
  if (!first.found()) return false;
  double x = first.at.value;
  const Certificate certificate = first_touch(approach, nullptr, x, first, counters);
  if (model_.faces()[first.face].check) return false;
  placement.pose = approach.pose(x);
  placement.first_contact = first.at.s;
  placement.tilt = 0;
  placement.first_normal =
      first.body ? placement.pose.axis : Vec3(-ring_distance(tool_, placement.pose, first.at.s).gradient);
  const bool on_axis = !((first.at.s - placement.pose.torus_center).head<2>().norm() > kMerged);
  if (tool_.major_radius > 0 && !on_axis && !first.body && certificate.verdict == Verdict::free) return true;
  placement.status = PositionStatus::one_contact;
  finish(placement, certificate);
  return false;
}

// From the upright tool of `placement` to the position.
void Exact::spin_and_tilt(double spin,
                          const Touch& first,
                          const std::vector<Start>& starts,
                          Placement& placement,
                          Counters& counters) const {
  Insert insert = insert_through(tool_, placement.pose, first.at.s);
  double open_side = 0;
  if (spin != 0) {
    const Vec3& normal = placement.first_normal;
    const Mat3 turn = rotation(normal, spin);
    insert = {insert.center, turn * insert.u1, turn * insert.v1, turn * insert.w1};
    open_side = -std::atan2(normal.dot(insert.w1), normal.dot(insert.v1));
  }
  tilt(first, insert, open_side, tilt_max_, starts, placement, counters);
}

Placement Exact::place(const Vec2& at, Counters& counters) const {
  thread_local std::vector<Start> starts;
  Placement placement;
  Touch first;
  if (drop(at, starts, first, placement, counters)) spin_and_tilt(spin_, first, starts, placement, counters);
  if (placement.pose.axis.allFinite()) placement.spin = spin_;
  return placement;
}

class Exact::Dropped final : public DroppedTool {
 public:
  Dropped(const Exact& method, const Vec2& at, Counters& counters)
      : method_(method), tilts_(method.drop(at, starts_, first_, upright_, counters)) {}

  Placement spun(double spin, Counters& counters) const override {
    Placement placement = upright_;
    if (tilts_) method_.spin_and_tilt(spin, first_, starts_, placement, counters);
    if (placement.pose.axis.allFinite()) placement.spin = spin;
    return placement;
  }

 private:
  const Exact& method_;
  std::vector<Start> starts_;
  Touch first_;
  Placement upright_;
  bool tilts_;
};

std::unique_ptr<DroppedTool> Exact::drop(const Vec2& at, Counters& counters) const {
  return std::make_unique<Dropped>(*this, at, counters);
}

// The insert's frame starts on the equator: v1 along the normal, the tool lying on the surface, and its far
// side comes down from there.
Placement Exact::place(const GivenContact& at, Counters& counters) const {
  Placement placement;
  const Face& face = model_.faces()[at.face];
  const ParamBox& domain = face.surface.domain();
  placement.status = PositionStatus::off_part;
  if (at.u < domain.u0 || at.u > domain.u1 || at.v < domain.v0 || at.v > domain.v1) return placement;
  if (face.check || !face.trim.contains(at.u, at.v)) return placement;
  const SurfacePoint p = face.surface.evaluate(at.u, at.v);
  Vec3 normal = p.su.cross(p.sv).normalized();
  if (normal.z() < 0) normal = -normal;
  const Vec3 along = at.ring_direction - at.ring_direction.dot(normal) * normal;
  const bool has_direction = along.norm() > kNoDirection * at.ring_direction.norm();
  const Vec3 u1 = along.normalized();
  placement.status = PositionStatus::undecided;
  // A pole has no normal, and a direction along the normal no part along the surface.
  if (!normal.allFinite() || !has_direction || !(tool_.major_radius > 0)) return placement;
  const Insert insert{p.s + tool_.minor_radius * normal, u1, normal, u1.cross(normal)};
  placement.first_contact = p.s, placement.first_normal = normal;
  placement.spin = 0;
  Touch first{at.face, {}, false};
  first.at.value = 0, first.at.u = at.u, first.at.v = at.v, first.at.s = p.s;
  thread_local std::vector<Start> starts;
  const double reach = 2 * tool_.radius();
  gather_starts([&](const Vec3& c, double radius) { return (c - p.s).norm() <= reach + radius; }, starts);
  tilt(first, insert, 0, kPi / 2 + tilt_max_, starts, placement, counters);
  return placement;
}

}  // namespace

std::map<std::string, double> exact_defaults() {
  return {{"gouge_mm", kGougeTolerance}, {"cell_budget", kCellBudget}};
}

std::unique_ptr<Method> make_exact(const SurfaceModel& model,
                                   const Tool& tool,
                                   const MethodOptions& options) {
  require(tool.minor_radius > 0,
          "minor_radius_mm: exact needs a rounded ring; for a flat end mill give its edge radius, for "
          "example 0.01");
  const double tolerance = options.numbers.at("gouge_mm"), budget = options.numbers.at("cell_budget");
  require(std::isfinite(tolerance) && tolerance > 0, "gouge_mm must be a positive number of mm");
  require(budget >= 1000 && budget <= 1e9, "cell_budget must be 1000 to 1e9");
  return std::make_unique<Exact>(model, tool, options);
}

}  // namespace mpm
