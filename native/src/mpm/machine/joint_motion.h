// Between two blocks all five axes run evenly from one set of readings to the next: how far that takes the
// tool off the way that was meant, its tip on the straight line and its axis on the great circle between the
// two poses.
#pragma once

#include "mpm/machine/forward.h"

namespace mpm {

struct MotionDeviation {
  double tip = 0;   // mm
  double axis = 0;  // radians
};

// The great circle that the tool was meant to take, by its ends: unit vectors. Where the joints do not meet
// them, near the pole, that counts as well.
struct AxisWay {
  Vec3 from, to;
};

// Upper bounds, over the whole motion, of the distances between where the tool is and where it was meant to
// be at the same fraction of the motion. Proven but for roundoff, and close: for short motions both tend to
// the largest distance there is.
//
// Method: of the difference e(s) of the two ways, less what joins its ends evenly, the second derivative is
//   that of e, so that it is at most |e''(1/2)| / 8 + max|e'''| / 48, the solution of
//   h'' = -(|e''(1/2)| + |s - 1/2| max|e'''|) with h(0) = h(1) = 0 at s = 1/2. The second derivative is
//   evaluated, the third bounded by the product rule over the chain, whose turns are by constant rates. To
//   this comes the larger of |e(0)| and |e(1)|.
// Requires: a chain from checked().
// Fails: an axis bound of pi says nothing: the motion turns too far for a bound.
MotionDeviation deviation_bound(const KinematicChain& chain,
                                const PartSetup& setup,
                                const Joints& from,
                                const Joints& to,
                                const AxisWay& meant);

// The bound of the axis alone; radians.
double axis_deviation_bound(const KinematicChain& chain,
                            const Vec2& from,
                            const Vec2& to,
                            const AxisWay& meant);

// What of that bound stays however short the motion is: how far (radians) the axis is off at its ends.
double axis_end_error(const KinematicChain& chain, const Vec2& from, const Vec2& to, const AxisWay& meant);

}  // namespace mpm
