#include "mpm/machine/refine.h"

#include <algorithm>
#include <cmath>

#include "mpm/base/error.h"
#include "mpm/machine/direction.h"

namespace mpm {
namespace {

// Each round at least doubles the pieces of a move that is not good yet, so this many reach kMaxPieces from
// one.
constexpr int kMaxRounds = 10;
constexpr double kSamples[] = {0.25, 0.5, 0.75};

// The path with move i in pieces[i] even pieces.
RefinedPath split(const PosePath& path, const std::vector<std::uint32_t>& pieces) {
  RefinedPath result;
  PosePath& out = result.poses;
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::uint32_t k = 1; k <= pieces[i]; ++k) {
      const double s = double(k) / pieces[i];
      const bool last = k == pieces[i];
      out.tip.push_back(last ? path.tip[i] : Vec3(path.tip[i - 1] + s * (path.tip[i] - path.tip[i - 1])));
      out.axis.push_back(last ? path.axis[i] : great_circle(path.axis[i - 1], path.axis[i], s));
      out.cutting.push_back(path.cutting[i]);
      result.source.push_back(std::uint32_t(i));
    }
  }
  return result;
}

// How many times more pieces this piece's move needs: the deviation falls with their square, the step with
// their number.
double excess(const KinematicChain& chain, const RefineOptions& options, const Vec2& from, const Vec2& to) {
  const double step = (to - from).cwiseAbs().maxCoeff();
  return std::max(std::sqrt(axis_deviation(chain, from, to) / options.axis_tolerance),
                  step / options.max_rotary_step);
}

// Raises the pieces of the moves that are not good yet; false when there are none.
bool raise_pieces(const KinematicChain& chain,
                  const RefineOptions& options,
                  const RefinedPath& refined,
                  std::vector<std::uint32_t>& pieces) {
  std::vector<double> worst(pieces.size(), 0.0);
  for (std::size_t j = 1; j < refined.poses.size(); ++j)
    if (refined.poses.cutting[j]) {
      double& of_move = worst[refined.source[j]];
      of_move =
          std::max(of_move, excess(chain, options, refined.joints.rotary[j - 1], refined.joints.rotary[j]));
    }
  bool raised = false;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (worst[i] <= 1.0 || pieces[i] == kMaxPieces) continue;
    const double wanted = std::ceil(pieces[i] * std::max(worst[i], pieces[i] > 1 ? 2.0 : 1.0));
    pieces[i] = std::uint32_t(std::min(wanted, double(kMaxPieces)));
    raised = true;
  }
  return raised;
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
  std::vector<std::uint32_t> pieces(path.size(), 1);
  RefinedPath refined;
  for (int round = 0; round < kMaxRounds; ++round) {
    refined = split(path, pieces);
    refined.joints = joint_path(chain, refined.poses, options.joints);
    if (!raise_pieces(chain, options, refined, pieces)) break;
  }
  return refined;
}

}  // namespace mpm
