#include "mpm/machine/refine.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/machine/direction.h"

namespace mpm {
namespace {

// Rounds of splitting: with each, a bad piece becomes half as long or shorter, down to 2^-20 of its move.
constexpr int kMaxRounds = 20;
// A bad piece is split in so many at most at a time: what it needs is only estimated.
constexpr double kMaxSplit = 8;
constexpr double kSamples[] = {0.25, 0.5, 0.75};

// For each move the fractions, rising to 1, at which its pieces end.
using Fractions = std::vector<std::vector<double>>;

RefinedPath split(const PosePath& path, const Fractions& fractions) {
  RefinedPath result;
  PosePath& out = result.poses;
  for (std::size_t i = 0; i < path.size(); ++i)
    for (double s : fractions[i]) {
      const bool last = s == 1.0;
      out.tip.push_back(last ? path.tip[i] : Vec3(path.tip[i - 1] + s * (path.tip[i] - path.tip[i - 1])));
      out.axis.push_back(last ? path.axis[i] : great_circle(path.axis[i - 1], path.axis[i], s));
      out.cutting.push_back(path.cutting[i]);
      result.source.push_back(std::uint32_t(i));
    }
  return result;
}

// How many pieces this one should become: the deviation falls with their square, the step with their number.
double pieces_needed(const KinematicChain& chain,
                     const RefineOptions& options,
                     const Vec2& from,
                     const Vec2& to) {
  const double step = (to - from).cwiseAbs().maxCoeff();
  const double needed = std::max(std::sqrt(axis_deviation(chain, from, to) / options.axis_tolerance),
                                 step / options.max_rotary_step);
  return std::min(std::ceil(needed), kMaxSplit);
}

// The ends of the pieces of one move after another round; refined pose `first` is the end of its first piece.
std::vector<double> split_further(const KinematicChain& chain,
                                  const RefineOptions& options,
                                  const RefinedPath& refined,
                                  std::size_t first,
                                  const std::vector<double>& ends) {
  std::vector<double> result;
  double start = 0.0;
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const Vec2 &from = refined.joints.rotary[first + k - 1], &to = refined.joints.rotary[first + k];
    const double pieces = pieces_needed(chain, options, from, to);
    for (double n = 1; n < pieces; ++n) result.push_back(start + n / pieces * (ends[k] - start));
    result.push_back(ends[k]);
    start = ends[k];
  }
  return result.size() <= kMaxPieces ? result : ends;
}

// Splits the pieces that are not good yet; false when there are none, or none that may be split.
bool split_bad_pieces(const KinematicChain& chain,
                      const RefineOptions& options,
                      const RefinedPath& refined,
                      Fractions& fractions) {
  bool any = false;
  std::size_t first = 0;  // refined pose that ends the first piece of move i
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    const std::size_t pieces = fractions[i].size();
    if (i > 0 && refined.poses.cutting[first]) {
      fractions[i] = split_further(chain, options, refined, first, fractions[i]);
      any = any || fractions[i].size() > pieces;
    }
    first += pieces;
  }
  return any;
}

}  // namespace

double axis_deviation(const KinematicChain& chain, const Vec2& from, const Vec2& to) {
  const Vec3 a = tool_axis(chain, from), b = tool_axis(chain, to);
  double worst = 0;
  for (double s : kSamples)
    worst = std::max(worst, angle_between(tool_axis(chain, from + s * (to - from)), great_circle(a, b, s)));
  return worst;
}

RefinedPath refine(const KinematicChain& chain, const PosePath& path, const RefineOptions& options) {
  require(options.axis_tolerance > 0, "axis_tolerance must be positive");
  require(options.max_rotary_step > 0, "max_rotary_step must be positive");
  Fractions fractions(path.size(), {1.0});
  RefinedPath refined;
  for (int round = 0; round <= kMaxRounds; ++round) {
    refined = split(path, fractions);
    refined.joints = joint_path(chain, refined.poses, options.joints);
    if (!split_bad_pieces(chain, options, refined, fractions)) break;
  }
  return refined;
}

}  // namespace mpm
