// Subdivision of cuts: between two blocks the control turns both rotary axes evenly, which is not the even
// turn of the tool from one axis to the next that the planner meant.
#pragma once

#include "mpm/machine/joint_path.h"

namespace mpm {

struct RefineOptions {
  JointPathOptions joints;
  double axis_tolerance = 0;  // radians, positive: of the axis off its great circle, in a cut
  // mm, positive: of the tip off its straight line. Finite for a control that moves the joints and knows
  // nothing of the tip: rapids are then split like cuts, for they too leave their line.
  double tip_tolerance = kInfinity;
  double max_rotary_step = kInfinity;  // radians, positive: largest turn of either axis in one block of a cut
};

struct RefinedPath {
  PosePath poses;                     // the given poses and those inserted between them
  std::vector<std::uint32_t> source;  // index of the given move that each move is part of
  // 1: the move keeps axis_tolerance and tip_tolerance all along it, its ends included; by deviation_bound
  std::vector<std::uint8_t> keeps;
  JointPath joints;
};

// The pole cone is cut down to this share of axis_tolerance: a quarter of it is then left between the ends.
inline constexpr double kConeShare = 0.375;

// Splits the cutting moves, where they need it, until each piece keeps axis_tolerance, tip_tolerance and
// max_rotary_step, all along it (deviation_bound): inserted tips lie on the straight line, inserted axes on
// the great circle. All joints are chosen anew for the refined path. The given poses are all kept, bit for
// bit, in their order. A cut through the pole cone gets a place in it, where the first axis turns, or the
// solution changes, while the tool hardly moves. No move gets more than kMaxPieces pieces; one that needs
// more ends with the tolerance not kept, and so does a rapid in which the rotary solution changes or an axis
// rewinds.
//
// Requires: a chain from checked().
// Fails: std::invalid_argument for tolerances and a step that are not positive, and as joint_path() does. A
//   tolerance that is not kept is told by `keeps`.
inline constexpr std::size_t kMaxPieces = 4096;
RefinedPath refine(const KinematicChain& chain, const PosePath& path, const RefineOptions& options);

}  // namespace mpm
