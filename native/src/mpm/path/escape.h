// A straight way between a position and the safe plane, up for a retract and down for an approach.
#pragma once

#include "mpm/base/context.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/path/pose_motion.h"

namespace mpm {

struct EscapeOptions {
  double safe_z;             // set-up z of the tip on the safe plane, mm
  double approach_distance;  // mm, how near to the surfaces a rapid may come
  double gouge;              // mm, how much deeper than the position itself the way may cut
  double check_step;         // mm between the checked poses where the surfaces are near
};

struct Escape {
  Vec3 direction;        // unit, away from the part
  double length;         // mm, from the position to the safe plane
  double plunge_length;  // mm, from the position to where the tool is approach_distance clear for good
  double clearance;      // mm, least found on the way, at most approach_distance
  bool blocked;          // it cuts more than `gouge` deeper than the position itself

  Vec3 top(const Vec3& tip) const { return tip + length * direction; }
  Vec3 plunge_start(const Vec3& tip) const { return tip + plunge_length * direction; }
};

// The way out of `position` with its axis kept: along the axis if that is free, else between the axis and z,
// else along z; when all are blocked, the one that cuts least (`blocked` says so). Clearances are sampled at
// poses at most max(check_step, clearance) apart: between two of them the clearance falls by at most half of
// check_step more. Requires position.axis.z > 0, position.tip.z < safe_z and check_step > 0. Once `context`
// is cancelled the answer means nothing.
Escape find_escape(const ClearanceSampler& sampler,
                   const Tool& tool,
                   const TipPose& position,
                   const EscapeOptions& options,
                   const Context& context);

}  // namespace mpm
