// Inverse of the tool axis: closed form for any pair of rotary axes.
#pragma once

#include <array>

#include "mpm/machine/kinematic_chain.h"

namespace mpm {

struct OrientationSolutions {
  // Readings of the two solutions, angles within pi of the zero offsets. The second axis of solution 0 stands
  // beyond, of solution 1 before the position where the tool comes nearest to the first axis (in angle, sense
  // aside). Not reachable: both hold the nearest orientation that is.
  std::array<Vec2, 2> rotary;
  bool reachable = true;
  double pole_distance = 0.0;  // angle between the tool and the line of the first axis, 0..pi/2
};

// Solves Rot(a1, q1) · Rot(a2, q2) · spindle_axis = axis.
//
// Method: two lines meeting in a point (Paden and Kahan's second subproblem), the angle at a2 by the
//   half-angle formula of the spherical triangle a2, a1, tool, which keeps full relative accuracy at the pole
//   and at the end of the reach.
// Source: Murray, Li and Sastry 1994, ch. 3.
// Requires: a chain from checked(); |axis| = 1, in the part's frame.
// Guarantees: a reachable axis is met to a few roundoffs (tests: 1e-12) by both solutions, everywhere. At the
//   pole the first axis is free and reads its zero offset.
// Fails: an axis out of reach is marked, not thrown: `reachable`.
// Threads: solve() may be asked from any number.
class OrientationInverse {
 public:
  explicit OrientationInverse(const KinematicChain& chain);
  OrientationSolutions solve(const Vec3& axis) const;

 private:
  double turn_of_first(const Vec3& from, const Vec3& to) const;

  std::array<RotaryAxis, 2> rotary_;
  Vec3 spindle_;
  double between_axes_;     // angle(a1, a2)
  double spindle_angle_;    // angle(a2, spindle)
  double nearest_to_pole_;  // q2 that brings the tool nearest to a1
};

}  // namespace mpm
