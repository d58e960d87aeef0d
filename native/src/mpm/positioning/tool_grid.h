// The gouge check of drop, spin and tilt (paper fig. 17): a polar grid on the ring's lower half against the
// surface's height.
#pragma once

#include "mpm/positioning/method.h"
#include "mpm/positioning/tool_shadow.h"

namespace mpm {

struct ToolGrid {
  int phi_divisions = 48, theta_divisions = 36;  // the paper's
  double gouge = 1e-3;                           // mm a grid point may lie below the surface

  // Does a grid point of the ring lie more than `gouge` below a face? `seeds`: where to start on each face.
  // Grid points not over a face count as free. Sampled: a "no" proves nothing.
  bool gouges(const SurfaceModel& model,
              const Tool& tool,
              const ToolPose& pose,
              const std::vector<Seed>& seeds,
              Counters& counters) const;
};

}  // namespace mpm
