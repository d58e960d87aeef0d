// The pose between two poses: the tip moves on a straight line, the axis on a great circle.
#pragma once

#include "mpm/base/types.h"

namespace mpm {

struct TipPose {
  Vec3 tip;
  Vec3 axis;  // unit, tip to spindle
};

// The pose at fraction `t` in [0, 1] of the move from `a` to `b`.
//
// Requires: unit axes that are not opposite; else the axis means nothing.
TipPose pose_between(const TipPose& a, const TipPose& b, double t);

}  // namespace mpm
