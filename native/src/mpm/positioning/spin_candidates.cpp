#include "mpm/positioning/spin_candidates.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

// A spacing is found to a tenth of what counts as reached.
constexpr double kMissSharpness = 0.1 * kSpacingTolerance;
constexpr int kRootSteps =
    16;  // of false position; a jump, where the contact changes sides, is given up then
constexpr int kBestSteps = 10;  // of golden sections: the circle's 10 degrees come down to 0.1
constexpr double kGolden = 0.3819660112501051;  // (3 - sqrt 5) / 2

class Search {
 public:
  Search(const DroppedTool& dropped, const SpacingRules& rules, Counters& counters, const Context& context)
      : dropped_(dropped), rules_(rules), counters_(counters), context_(context) {}

  struct Sample {
    double spin = kNaN, excess = kNaN;  // mm of spacing more than wanted; NaN: no pose, or no spacing
    SpinCandidate candidate;
    bool known() const { return std::isfinite(excess); }
    bool reached() const { return candidate.reached(); }
  };

  Sample at(double spin) const;
  std::vector<Sample> circle() const;
  void between(const Sample& a, const Sample& b, std::vector<Sample>& found) const;
  void round_best(const Sample& a, const Sample& b, const Sample& c, std::vector<Sample>& found) const;

 private:
  const DroppedTool& dropped_;
  const SpacingRules& rules_;
  Counters& counters_;
  const Context& context_;
};

Search::Sample Search::at(double spin) const {
  Sample sample;
  sample.spin = spin;
  if (context_.cancelled()) return sample;
  sample.candidate.placement = dropped_.spun(std::remainder(spin, 2 * kPi), counters_);
  const Placement& placement = sample.candidate.placement;
  if (placement.status == PositionStatus::undecided) return sample;
  if (!(placement.pose.axis.z() >= std::cos(rules_.axis_max))) return sample;
  sample.candidate.spacing = contact_spacing(placement, rules_);
  sample.excess = sample.candidate.spacing - rules_.wanted;
  if (sample.known()) sample.candidate.miss = std::abs(sample.excess) / rules_.wanted;
  return sample;
}

std::vector<Search::Sample> Search::circle() const {
  std::vector<Sample> samples;
  for (int k = 0; k < rules_.samples; ++k) samples.push_back(at(-kPi + 2 * kPi * k / rules_.samples));
  return samples;
}

bool opposite(double a, double b) { return (a < 0) != (b < 0); }

// A solution between two spins of opposite excess: the Illinois form of false position.
void Search::between(const Sample& a, const Sample& b, std::vector<Sample>& found) const {
  double x0 = a.spin, y0 = a.excess, x1 = b.spin, y1 = b.excess;
  for (int step = 0; step < kRootSteps; ++step) {
    const Sample next = at((x0 * y1 - x1 * y0) / (y1 - y0));
    if (!next.known()) return;
    if (next.candidate.miss <= kMissSharpness) {
      found.push_back(next);
      return;
    }
    if (opposite(next.excess, y1))
      x0 = x1, y0 = y1;
    else
      y0 *= 0.5;
    x1 = next.spin, y1 = next.excess;
  }
}

// b misses less than its neighbours a and c, all to the same side: golden sections towards the best spin
// between them, until it is found or the sign changes, which leads to two solutions.
void Search::round_best(const Sample& a, const Sample& b, const Sample& c, std::vector<Sample>& found) const {
  Sample lo = a, best = b, hi = c;
  for (int step = 0; step < kBestSteps; ++step) {
    const bool right = hi.spin - best.spin > best.spin - lo.spin;
    const Sample next = at(best.spin + kGolden * ((right ? hi.spin : lo.spin) - best.spin));
    if (!next.known()) break;
    if (opposite(next.excess, best.excess)) {
      between(right ? best : lo, next, found);
      between(next, right ? hi : best, found);
      return;
    }
    const bool better = next.candidate.miss < best.candidate.miss;
    (right == better ? lo : hi) = better ? best : next;
    if (better) best = next;
  }
  found.push_back(best);
}

// What `samples` and their neighbours lead to: solutions, and local bests.
std::vector<Search::Sample> refined(const Search& search, const std::vector<Search::Sample>& samples) {
  std::vector<Search::Sample> found;
  const std::size_t n = samples.size();
  for (std::size_t k = 0; k < n; ++k) {
    Search::Sample before = samples[(k + n - 1) % n], after = samples[(k + 1) % n];
    const Search::Sample& here = samples[k];
    if (k == 0) before.spin -= 2 * kPi;
    if (k == n - 1) after.spin += 2 * kPi;
    if (!here.known()) continue;
    if (after.known() && opposite(here.excess, after.excess)) search.between(here, after, found);
    const auto worse = [&](const Search::Sample& s) {
      return !s.known() || (!opposite(s.excess, here.excess) && s.candidate.miss >= here.candidate.miss);
    };
    if (!worse(before) || !worse(after)) continue;
    if (before.known() && after.known())
      search.round_best(before, here, after, found);
    else
      found.push_back(here);
  }
  return found;
}

}  // namespace

std::vector<SpinCandidate> spin_candidates(const DroppedTool& dropped,
                                           const SpacingRules& rules,
                                           Counters& counters,
                                           const Context& context) {
  const Search search(dropped, rules, counters, context);
  const std::vector<Search::Sample> found = refined(search, search.circle());
  const bool reached = std::any_of(found.begin(), found.end(), [](const auto& s) { return s.reached(); });
  std::vector<SpinCandidate> candidates;
  for (const Search::Sample& sample : found)
    if (sample.reached() || !reached) candidates.push_back(sample.candidate);
  if (candidates.empty()) candidates.push_back(search.at(0).candidate);
  return candidates;
}

}  // namespace mpm
