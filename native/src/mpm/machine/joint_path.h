// Joint values over a whole path: which of the two orientation solutions where, unwound, within limits.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/machine/forward.h"

namespace mpm {

// A turn in a cut longer than half a turn by more than this (radians) is a rewind; less is rounding.
inline constexpr double kHalfTurnSlack = 1e-9;

// A path as poses in the part's frame; the move that ends in pose i starts in pose i - 1.
struct PosePath {
  std::vector<Vec3> tip;              // mm
  std::vector<Vec3> axis;             // unit, tip to spindle
  std::vector<std::uint8_t> cutting;  // 1: the move that ends here cuts

  std::size_t size() const { return tip.size(); }
};

struct JointPathOptions {
  PartSetup setup;
  // Nearer to the pole than this (radians) the first axis follows its neighbours instead of the pose; the
  // tool axis is then off by at most twice this angle, also where the chain comes no nearer to its pole.
  double pole_cone = 0.0;
};

enum class JointStatus : std::uint8_t {
  ok,
  unreachable,   // no rotary readings give this axis; the joints are the nearest that exist
  rotary_limit,  // a rotary axis leaves its limits
  linear_limit,  // a linear axis leaves its limits
  forced_turn,   // the cut that ends here needs a change of solution or a rewind
};
inline constexpr std::array kJointStatusNames = {
    "ok", "unreachable", "rotary_limit", "linear_limit", "forced_turn"};

struct JointPath {
  std::vector<Vec2> rotary;           // readings, unwound
  std::vector<Vec3> linear;           // readings
  std::vector<std::uint8_t> branch;   // solution of OrientationInverse, 0 or 1
  std::vector<std::uint8_t> at_pole;  // 1: inside the pole cone
  std::vector<JointStatus> status;
};

// The joint path of least cost, by dynamic programming over all poses at once. In this order it avoids poses
// beyond a limit and changes of solution or rewinds in a cut, then poses on the solution that is not
// preferred, then time (of the slower rotary axis, from reading zero). What cannot be avoided is done and
// marked in `status`.
//
// Requires: a chain from checked().
// Guarantees: one entry a pose; in cuts both unwound axes turn at most pi a move; solutions change only where
//   the move does not cut or within the pole cone, where both meet (else forced_turn); an axis with limits
//   keeps whole turns that fit them where any do.
// Fails: std::invalid_argument for arrays of different length, a tip that is not finite, an axis that is not
//   a unit vector, a negative pole cone. What no joints can do is a status.
// Source: the shortest-path view of Makhanov and Munlin (2006); costs are ours.
JointPath joint_path(const KinematicChain& chain, const PosePath& path, const JointPathOptions& options);

}  // namespace mpm
