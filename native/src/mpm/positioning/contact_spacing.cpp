#include "mpm/positioning/contact_spacing.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/positioning/spin_candidates.h"

namespace mpm {
namespace {

using Candidates = std::vector<SpinCandidate>;

constexpr std::size_t kGrain = 1;  // some 60 positions each
// What a position costs beside others: these count the same, and in squares, so that a change is spread over
// many positions rather than made at once.
constexpr double kMissUnit = 0.01;       // of the wanted spacing, missed beyond the least possible
constexpr double kTurnUnit = kPi / 180;  // of the axis, from position to position
// mm of the tip, seen from the footprint point: a spun tool goes round P. A way of the machine, as the turn
// is: no part of the tool.
constexpr double kShiftUnit = 1;

double squared(double x) { return x * x; }

double least_miss(const Candidates& candidates) {
  double least = kInfinity;
  for (const SpinCandidate& one : candidates) least = std::min(least, one.miss);
  return least;
}

double miss_cost(const SpinCandidate& candidate, double least) {
  return candidate.reached() || !std::isfinite(least) ? 0 : squared((candidate.miss - least) / kMissUnit);
}

double move_cost(const Vec2& at_a, const ToolPose& a, const Vec2& at_b, const ToolPose& b) {
  if (!a.axis.allFinite() || !b.axis.allFinite()) return 0;
  const double turn = std::atan2(a.axis.cross(b.axis).norm(), a.axis.dot(b.axis));
  const Vec2 shift = (b.torus_center.head<2>() - at_b) - (a.torus_center.head<2>() - at_a);
  return squared(turn / kTurnUnit) + shift.squaredNorm() / squared(kShiftUnit);
}

// For each position of one pass the candidate on the cheapest way through all (Viterbi). Of equal ways the
// one with the lower indices wins.
std::vector<std::size_t> cheapest(std::span<const Vec2> at, std::span<const Candidates> pass) {
  std::vector<std::vector<double>> sum(pass.size());
  std::vector<std::vector<std::size_t>> came_from(pass.size());
  for (std::size_t i = 0; i < pass.size(); ++i) {
    const double unavoidable = least_miss(pass[i]);
    for (const SpinCandidate& here : pass[i]) {
      double least = i == 0 ? 0 : kInfinity;
      std::size_t from = 0;
      for (std::size_t k = 0; i > 0 && k < pass[i - 1].size(); ++k) {
        const ToolPose& before = pass[i - 1][k].placement.pose;
        const double total = sum[i - 1][k] + move_cost(at[i - 1], before, at[i], here.placement.pose);
        if (total < least) least = total, from = k;
      }
      sum[i].push_back(least + miss_cost(here, unavoidable));
      came_from[i].push_back(from);
    }
  }
  std::vector<std::size_t> chosen(pass.size());
  std::size_t k = std::size_t(std::min_element(sum.back().begin(), sum.back().end()) - sum.back().begin());
  for (std::size_t i = pass.size(); i-- > 0; k = came_from[i][k]) chosen[i] = k;
  return chosen;
}

std::vector<Candidates> candidates_of_all(const Method& method,
                                          const std::vector<Vec2>& points,
                                          const SpacingRules& rules,
                                          Counters& counters,
                                          Context& context) {
  std::vector<Candidates> all(points.size());
  std::mutex adding;
  context.start(points.size());
  for_each_range(points.size(), kGrain, context, [&](std::size_t begin, std::size_t end) {
    Counters work;
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i)
      all[i] = spin_candidates(*method.drop(points[i], work), rules, work, context);
    const std::lock_guard lock(adding);
    counters.add(work);
  });
  return all;
}

double nearest_of(const Candidates& candidates) {
  const auto less = [](const SpinCandidate& a, const SpinCandidate& b) { return a.miss < b.miss; };
  return std::min_element(candidates.begin(), candidates.end(), less)->spacing;
}

void choose(std::span<const Vec2> at,
            std::span<const Candidates> pass,
            std::size_t begin,
            SpacedPlacements& result) {
  const std::vector<std::size_t> chosen = cheapest(at, pass);
  for (std::size_t i = 0; i < pass.size(); ++i) {
    const SpinCandidate& one = pass[i][chosen[i]];
    result.placed.positions[begin + i] = one.placement;
    result.spacing[begin + i] = one.spacing;
    result.nearest[begin + i] = nearest_of(pass[i]);
  }
}

}  // namespace

SpacedPlacements place_spaced(const Method& method,
                              const std::vector<Vec2>& points,
                              const std::vector<std::int64_t>& pass_index,
                              const SpacingRules& rules,
                              Context& context) {
  require(points.size() == pass_index.size(), "pass_index must have one entry for each point");
  require(std::isfinite(rules.wanted) && rules.wanted > 0,
          "contact_spacing_mm must be a positive number of mm");
  require(rules.samples >= 4, "samples must be 4 or more");
  SpacedPlacements result;
  const std::size_t n = points.size();
  result.placed.positions.resize(n);
  result.spacing.assign(n, kNaN), result.nearest.assign(n, kNaN);
  const std::vector<Candidates> all =
      candidates_of_all(method, points, rules, result.placed.counters, context);
  if (context.cancelled()) return result;
  for (std::size_t begin = 0, end = 0; begin < n; begin = end) {
    while (end < n && pass_index[end] == pass_index[begin]) ++end;
    const std::size_t count = end - begin;
    choose(std::span(points).subspan(begin, count), std::span(all).subspan(begin, count), begin, result);
  }
  return result;
}

}  // namespace mpm
