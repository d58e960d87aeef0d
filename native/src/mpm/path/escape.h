// A straight way between a position and the safe plane, up for a retract and down for an approach.
#pragma once

#include "mpm/base/context.h"
#include "mpm/base/pose_motion.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/surface/cell_tree.h"

namespace mpm {

struct EscapeOptions {
  double safe_z;             // set-up z of the tip on the safe plane, mm
  double approach_distance;  // mm, how near to the surfaces a rapid may come
  double gouge;              // mm, how much deeper than the position itself the way may cut
  double check_step;         // mm between the checked poses where the surfaces are near
  double depth;              // mm, what the plunge part of a proven way may cut in; the rest must be clear
  double tip_deviation;      // mm, what the real tip may be off the way ...
  double axis_deviation;     // radians, ... and the real axis off the position's
};

struct Escape {
  Vec3 direction;        // unit, away from the part
  double length;         // mm, from the position to the safe plane
  double plunge_length;  // mm, from the position to where the tool is approach_distance clear for good
  double clearance;      // mm: of a proven way the lower bound, at most 0; else the least sample found
  bool blocked;          // a sample cuts more than `gouge` deeper than the position itself
  bool proven;           // cuts no deeper than `depth` on the plunge part, and is clear on the rest

  Vec3 top(const Vec3& tip) const { return tip + length * direction; }
  Vec3 plunge_start(const Vec3& tip) const { return tip + plunge_length * direction; }
};

// The way out of `position` with its axis kept: along the axis, half-way between the axis and z, or along z:
// the first of them that is proven (certify_motion, deviations included); when none is, the first that
// samples find free; when all are blocked, the one that cuts least (`blocked` says so). Samples are taken at
// poses at most max(check_step, clearance) apart; what they find blocked is not tried to be proven.
//
// Requires: position.axis.z > 0, position.tip.z < safe_z, check_step > 0: link_passes() sees to it.
// Fails: `blocked`; once `context` is cancelled the answer means nothing.
// Threads: any number may share sampler and cells.
Escape find_escape(const ClearanceSampler& sampler,
                   const CellTree& cells,
                   const Tool& tool,
                   const TipPose& position,
                   const EscapeOptions& options,
                   const Context& context);

}  // namespace mpm
