#include "mpm/machine/refine.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "mpm/base/direction.h"
#include "mpm/base/error.h"
#include "mpm/machine/joint_motion.h"

namespace mpm {
namespace {

// Rounds of splitting: with each, a bad piece becomes half as long or shorter, down to 2^-20 of its move.
constexpr int kMaxRounds = 20;
// A bad piece is split in so many at most at a time: what it needs is only estimated.
constexpr double kMaxSplit = 8;

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

// The fraction of the way from a to b, between its ends, at which the axis comes nearest to the line of the
// first rotary axis, when that is within the cone.
std::optional<double> fraction_in_cone(const Vec3& a, const Vec3& b, const Vec3& line, double cone) {
  const double angle = angle_between(a, b);
  if (angle == 0) return std::nullopt;
  const Vec3 normal = a.cross(b).normalized();
  for (const Vec3& pole : {line, Vec3(-line)}) {
    const Vec3 nearest = pole - normal.dot(pole) * normal;
    const double s = std::atan2(normal.dot(a.cross(nearest)), a.dot(nearest)) / angle;
    if (s > 0 && s < 1 && angle_between(great_circle(a, b, s), pole) <= cone) return s;
  }
  return std::nullopt;
}

// Cuts through the pole cone have a place in it from the start: there both rotary solutions meet.
Fractions through_the_cone(const KinematicChain& chain, const PosePath& path, double cone) {
  Fractions fractions(path.size(), {1.0});
  for (std::size_t i = 1; i < path.size(); ++i)
    if (path.cutting[i])
      if (const auto s =
              fraction_in_cone(path.axis[i - 1], path.axis[i], chain.rotary[0].rotation_vector, cone))
        fractions[i] = {*s, 1.0};
  return fractions;
}

Joints joints_at(const JointPath& path, std::size_t i) { return {path.linear[i], path.rotary[i]}; }

AxisWay meant(const RefinedPath& refined, std::size_t end) {
  return {refined.poses.axis[end - 1], refined.poses.axis[end]};
}

MotionDeviation deviation(const KinematicChain& chain,
                          const RefineOptions& options,
                          const RefinedPath& refined,
                          std::size_t end) {
  const Joints from = joints_at(refined.joints, end - 1), to = joints_at(refined.joints, end);
  if (std::isfinite(options.tip_tolerance))
    return deviation_bound(chain, options.joints.setup, from, to, meant(refined, end));
  return {0, axis_deviation_bound(chain, from.rotary, to.rotary, meant(refined, end))};
}

// The deviation as a multiple of what is allowed.
double excess(const RefineOptions& options, const MotionDeviation& off) {
  return std::max(off.tip / options.tip_tolerance, off.axis / options.axis_tolerance);
}

// The same of what splitting lessens: not of how far the axis is off at the ends.
double reducible_excess(const KinematicChain& chain,
                        const RefineOptions& options,
                        const RefinedPath& refined,
                        std::size_t end) {
  const JointPath& joints = refined.joints;
  const MotionDeviation off = deviation(chain, options, refined, end);
  const double stays = axis_end_error(chain, joints.rotary[end - 1], joints.rotary[end], meant(refined, end));
  const double left = options.axis_tolerance - stays;
  return std::max(off.tip / options.tip_tolerance,
                  (off.axis - stays) / (left > 0 ? left : options.axis_tolerance));
}

// True when the move that ends there is to be split where it does not keep the tolerances.
bool may_split(const RefineOptions& options, const RefinedPath& refined, std::size_t end) {
  if (refined.poses.cutting[end]) return true;
  const JointPath& joints = refined.joints;
  const double turn = (joints.rotary[end] - joints.rotary[end - 1]).cwiseAbs().maxCoeff();
  return std::isfinite(options.tip_tolerance) && joints.branch[end] == joints.branch[end - 1] &&
         turn <= kPi + kHalfTurnSlack;
}

// How many pieces this one should become: the deviation falls with their square, the step with their number.
double pieces_needed(const KinematicChain& chain,
                     const RefineOptions& options,
                     const RefinedPath& refined,
                     std::size_t end) {
  const Vec2 turn = refined.joints.rotary[end] - refined.joints.rotary[end - 1];
  const double needed = std::max(std::sqrt(reducible_excess(chain, options, refined, end)),
                                 turn.cwiseAbs().maxCoeff() / options.max_rotary_step);
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
    const std::size_t end = first + k;
    const double pieces = may_split(options, refined, end) ? pieces_needed(chain, options, refined, end) : 1;
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
    if (i > 0) {
      fractions[i] = split_further(chain, options, refined, first, fractions[i]);
      any = any || fractions[i].size() > pieces;
    }
    first += pieces;
  }
  return any;
}

std::vector<std::uint8_t> kept(const KinematicChain& chain,
                               const RefineOptions& options,
                               const RefinedPath& refined) {
  std::vector<std::uint8_t> result(refined.poses.size(), 1);
  for (std::size_t i = 1; i < result.size(); ++i)
    result[i] = excess(options, deviation(chain, options, refined, i)) <= 1;
  return result;
}

// In the pole cone the axis is off by up to twice the cone: some of its tolerance must be left for the
// motion.
RefineOptions with_cone_in_tolerance(RefineOptions options) {
  options.joints.pole_cone = std::min(options.joints.pole_cone, kConeShare * options.axis_tolerance);
  return options;
}

}  // namespace

RefinedPath refine(const KinematicChain& chain, const PosePath& path, const RefineOptions& given) {
  const RefineOptions options = with_cone_in_tolerance(given);
  require(options.axis_tolerance > 0, "axis_tolerance must be positive");
  require(options.tip_tolerance > 0, "tip_tolerance must be positive");
  require(options.max_rotary_step > 0, "max_rotary_step must be positive");
  Fractions fractions = through_the_cone(chain, path, options.joints.pole_cone);
  RefinedPath refined;
  for (int round = 0; round <= kMaxRounds; ++round) {
    refined = split(path, fractions);
    refined.joints = joint_path(chain, refined.poses, options.joints);
    if (!split_bad_pieces(chain, options, refined, fractions)) break;
  }
  refined.keeps = kept(chain, options, refined);
  return refined;
}

}  // namespace mpm
