// How deep the tool's way cuts along free rays: the deviation of the machined surface, and its sections.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/removal/tool_sweep.h"

namespace mpm {

// Rays that start on a true surface and lead out of the part (set-up frame), and how far the material
// reaches: it fills -below <= t <= height[i] of ray i at first.
struct NormalRays {
  std::vector<Ray> rays;
  std::vector<double> height;      // mm, in and out
  std::vector<std::int32_t> move;  // the move that cut there last, -1: none; in and out
  double below = 0;                // mm, how deep a gouge is looked for
};

// Lowers each height to where the material that stands on the true surface now ends: above 0 what remains,
// below 0 how deep the tool has cut in. A part of the ray that is cut out within the material does not count.
//
// Guarantees: exact to kRayEpsilon but for what docs/removal.md says of a stroke's second dip; the same for
//   any order of the moves and any number of threads.
// Fails: std::invalid_argument for arrays of different length, origins that are not finite, directions that
//   are not unit vectors, and a negative `below`. A cancelled call leaves the heights half done.
void cut_rays(NormalRays& rays, const ToolSweep& sweep, Context& context);

}  // namespace mpm
