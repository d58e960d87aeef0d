// Subdivision of cuts: between two blocks the control turns both rotary axes evenly, which is not the even
// turn of the tool from one axis to the next that the planner meant.
#pragma once

#include "mpm/machine/joint_path.h"

namespace mpm {

// Largest angle (radians) between the tool while both rotary axes run evenly from one pair of readings to
// another and the tool on the great circle between its two end directions, at a quarter, half and three
// quarters of the move.
double axis_deviation(const KinematicChain& chain, const Vec2& from, const Vec2& to);

struct RefineOptions {
  JointPathOptions joints;
  double axis_tolerance = 0;           // radians, positive: allowed axis_deviation of a cut
  double max_rotary_step = kInfinity;  // radians, positive: largest turn of either axis in one block of a cut
};

struct RefinedPath {
  PosePath poses;                     // the given poses and those inserted between them
  std::vector<std::uint32_t> source;  // index of the given move that each move is part of
  JointPath joints;
};

// Splits the cutting moves, where they need it, until each piece keeps axis_tolerance and max_rotary_step:
// inserted tips lie on the straight line, inserted axes on the great circle. All joints are chosen anew for
// the refined path. The given poses are all kept, bit for bit, in their order. No move gets more than
// kMaxPieces pieces; one that needs more (it goes through the pole itself, where the first axis has to turn
// in no distance) ends with the tolerance not kept.
inline constexpr std::size_t kMaxPieces = 4096;
RefinedPath refine(const KinematicChain& chain, const PosePath& path, const RefineOptions& options);

}  // namespace mpm
