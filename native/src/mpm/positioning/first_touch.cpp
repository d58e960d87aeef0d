#include "mpm/positioning/first_touch.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kStartPerRadius = 1.0 / 4;  // cells whose centres start the searches
// mm: contacts are found to this depth. No part of the tool: far below any tolerance of a machine, and where
// coordinates are so large that it is rounding, kSharpRoundoff of them takes its place.
constexpr double kSharpness = 1e-9;
constexpr double kSharpRoundoff = 4096 * kRoundoff;
constexpr std::uint32_t kSharpBudget = 4000;  // cells; a ring lying on the surface is not resolved further
constexpr int kMaxRounds = 64;                // contacts tried before a position is given up
constexpr int kPointRounds = 16;              // of these, in which a point's own arrival may be taken
constexpr int kBisections = 50;
// Of the cutter's radius: what an arrival near P loses to 0/0 depends on the distance from P as part of the
// tool.
constexpr double kMergedPart = 1.0 / 635;

// The body's way back to where a point is clear of it: a first step far below what a tolerance sees, doubled,
// but no longer than a part of the tool, so that a gap as wide as that is not stepped over. A touch earlier
// by less than `no_gain` is the same: an arrival is good to some 1e-10 of the motion.
struct Steps {
  double first_back, longest_back, no_gain;
};

// Lengths, as parts of the cutter's radius.
Steps steps_of(const Drop&, const Tool& tool) {
  constexpr double kFirstBack = 8e-8, kLongestBack = 1.0 / 32, kNoGain = 8e-10;
  return {kFirstBack * tool.radius(), kLongestBack * tool.radius(), kNoGain * tool.radius()};
}

// Angles, which need no scale.
Steps steps_of(const Tilt&, const Tool&) {
  constexpr double kFirstBack = 1e-6, kLongestBack = 1.0 / 32, kNoGain = 1e-8;
  return {kFirstBack, kLongestBack, kNoGain};
}

Touch at_point(const Witness& w, double x) {
  Touch touch{w.face, {}, true};
  touch.at.value = x, touch.at.u = w.u, touch.at.v = w.v, touch.at.s = w.s;
  return touch;
}

}  // namespace

FirstTouch::FirstTouch(const CellTree& tree,
                       const Tool& tool,
                       double gouge_tolerance,
                       std::uint32_t cell_budget)
    : tree_(tree), tool_(tool) {
  const Box3& box = tree.model().bounds();
  const double size = std::max(box.lo.cwiseAbs().maxCoeff(), box.hi.cwiseAbs().maxCoeff()) + tool.length();
  judge_.tolerance = gouge_tolerance;
  judge_.budget = cell_budget;
  noise_ = kSharpRoundoff * size;
  judge_.sharpness = std::min(std::max(kSharpness, noise_), judge_.tolerance);
  judge_.sharp_budget = std::min(kSharpBudget, judge_.budget / 2);
  judge_.stop_at_violation = true;
}

double FirstTouch::merged() const { return kMergedPart * tool_.radius(); }

double FirstTouch::highest_drop() const {
  return -(tree_.model().bounds().hi.z() + tool_.radius() + judge_.tolerance);
}

// Cells that `near(centre, radius)` lets through.
template <class Near>
void FirstTouch::gather_starts(const Near& near, std::vector<Start>& starts) const {
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
    if (!node.trimmed || tree_.model().faces()[node.face].trim.contains(u, v))
      starts.push_back({node.face, u, v, node.cell.c});
  }
}

void FirstTouch::starts_under(const Vec2& at, std::vector<Start>& starts) const {
  gather_starts(
      [&](const Vec3& c, double radius) {
        return (c.head<2>() - at).squaredNorm() <= (tool_.radius() + radius) * (tool_.radius() + radius);
      },
      starts);
}

void FirstTouch::starts_round(const Vec3& center, double reach, std::vector<Start>& starts) const {
  gather_starts([&](const Vec3& c, double radius) { return (c - center).norm() <= reach + radius; }, starts);
}

template <Approach A>
Touch FirstTouch::refine(
    const A& approach, std::uint32_t face, double u, double v, Counters& counters) const {
  Touch touch{face, first_arrival(tool_, approach, tree_.model().faces()[face], u, v)};
  counters.newton_steps += std::uint64_t(touch.at.newton_steps);
  counters.evaluations += std::uint64_t(touch.at.newton_steps) + 1;
  return touch;
}

template <Approach A>
Touch FirstTouch::best_start(const A& approach,
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

// The greatest x' < x at which s is not inside the tool any more, for a point that is inside at x; `least`
// when there is none before it.
template <Approach A>
double FirstTouch::body_arrival(const A& approach, double x, double least, const Vec3& s) const {
  const auto clear = [&](double at) {
    return signed_distance(tool_, approach.pose(at), s) >= judge_.tolerance / 2;
  };
  const Steps steps = steps_of(approach, tool_);
  double inside = x, step = steps.first_back;
  while (!clear(std::max(x - step, least))) {
    if (x - step <= least) return least;
    inside = x - step;
    step = std::min(2 * step, step + steps.longest_back);
  }
  double outside = std::max(x - step, least);
  for (int k = 0; k < kBisections; ++k) {
    const double middle = 0.5 * (inside + outside);
    (clear(middle) ? outside : inside) = middle;
  }
  return outside;
}

// The pose at x; what it costs is taken off the budget.
template <Approach A>
Stop FirstTouch::judged(
    const A& approach, double x, const Touch& last, CertifyPoseOptions& options, Counters& counters) const {
  const Stop stop{x, last, JudgedPose(tree_, tool_, approach.pose(x), options)};
  const std::uint64_t cells = stop.judged.certificate().cells;
  counters.cells += cells;
  options.budget -= std::uint32_t(std::min<std::uint64_t>(cells, options.budget));
  return stop;
}

// The touch that the point inside the tool at x leads to; not found where that is none before x. `ring`: its
// first arrival. The nearest arrival may be on the wrong one of two borders: then the point's own is taken.
template <Approach A>
Touch FirstTouch::earlier(
    const A& approach, double x, const Witness& w, const Touch& ring, bool by_point) const {
  if (ring.at.value < x) return ring;
  const double own = by_point ? approach.arrival(w.s) : kInfinity;
  if (!(own < x - steps_of(approach, tool_).no_gain)) return {};
  Touch touch = ring;  // held by the same border
  touch.at.value = own, touch.at.u = w.u, touch.at.v = w.v, touch.at.s = w.s;
  return touch;
}

template <Approach A>
Stop FirstTouch::come_down(const A& approach,
                           const Descent& descent,
                           CertifyPoseOptions& options,
                           Counters& counters) const {
  const double no_gain = steps_of(approach, tool_).no_gain;
  double x = descent.from;
  Touch last = descent.last;
  for (int round = 0; x > descent.least; ++round) {
    const Stop stop = judged(approach, x, last, options, counters);
    const Witness& w = stop.judged.certificate().witness;
    const bool is_violation = w.distance < -options.sharpness;
    const bool is_dent = w.distance < -noise_ && options.stop_at_violation;
    if (!(is_violation || is_dent) || round == kMaxRounds || options.budget == 0) return stop;
    const Touch ring = refine(approach, w.face, w.u, w.v, counters);
    const bool is_other = !(descent.kept && same_contact(ring, *descent.kept));
    // A depth less than asked for is a long way in x where the contacts are about to merge, and only there.
    if (!is_violation && !(is_other && ring.at.value < x - no_gain)) return stop;
    const Touch next = is_other ? earlier(approach, x, w, ring, round < kPointRounds) : Touch{};
    if (next.found()) {
      x = next.at.value, last = next;
      continue;
    }
    options.stop_at_violation = false;
    options.sharpness = options.tolerance / 2;
    if (w.distance >= -options.sharpness) continue;
    const double body = body_arrival(approach, x, descent.least, w.s);
    if (body < x) x = body, last = at_point(w, x);
  }
  // Judged to the tolerance and to the end: a touch is no longer looked for.
  options.stop_at_violation = false;
  options.sharpness = options.tolerance;
  return judged(approach, descent.least, last, options, counters);
}

// Where the beginning is blocked, points may leave the tool where their arrival is, and the arrivals mislead.
// So x comes down from point to point: to the greatest x at which the deepest point is outside, until none is
// inside.
template <Approach A>
Stop FirstTouch::highest_free(const A& approach,
                              const Descent& descent,
                              const Stop& blocked,
                              CertifyPoseOptions& options,
                              Counters& counters) const {
  options.stop_at_violation = false;
  options.sharpness = options.tolerance / 2;
  Stop stop = judged(approach, descent.most, {}, options, counters);
  for (int round = 0; stop.judged.certificate().hi < -options.sharpness; ++round) {
    if (options.budget == 0 || round == kMaxRounds) return blocked;
    const Witness& w = stop.judged.certificate().witness;
    const double x = body_arrival(approach, stop.x, descent.least, w.s);
    if (x <= descent.least || !(x < stop.x)) return blocked;
    stop = judged(approach, x, at_point(w, x), options, counters);
  }
  if (!stop.judged.is_free()) return blocked;
  if (!stop.last.found()) return stop;
  // The ring's own touch just above is the sharp one.
  const Touch ring = refine(approach, stop.last.face, stop.last.at.u, stop.last.at.v, counters);
  if (!(ring.at.value > stop.x && ring.at.value < stop.x + steps_of(approach, tool_).longest_back))
    return stop;
  if (descent.kept && same_contact(ring, *descent.kept)) return stop;
  options.stop_at_violation = true;
  options.sharpness = judge_.sharpness;
  const Stop sharp =
      come_down(approach, {ring.at.value, stop.x, ring.at.value, ring, descent.kept}, options, counters);
  return sharp.judged.is_free() ? sharp : stop;
}

template <Approach A>
Stop FirstTouch::operator()(const A& approach, const Descent& descent, Counters& counters) const {
  CertifyPoseOptions options = judge_;
  const Stop stop = come_down(approach, descent, options, counters);
  const bool is_blocked = stop.x <= descent.least && descent.most > descent.least && !stop.judged.is_free();
  return is_blocked ? highest_free(approach, descent, stop, options, counters) : stop;
}

template Touch FirstTouch::best_start(const Drop&, const std::vector<Start>&, double, Counters&) const;
template Touch FirstTouch::best_start(const Tilt&, const std::vector<Start>&, double, Counters&) const;
template Touch FirstTouch::refine(const Drop&, std::uint32_t, double, double, Counters&) const;
template Touch FirstTouch::refine(const Tilt&, std::uint32_t, double, double, Counters&) const;
template Stop FirstTouch::operator()(const Drop&, const Descent&, Counters&) const;
template Stop FirstTouch::operator()(const Tilt&, const Descent&, Counters&) const;

}  // namespace mpm
