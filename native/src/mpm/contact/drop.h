// Dropping an upright tool: the set-up frame, axis = +z.
#pragma once

#include <cmath>

#include "mpm/tool/tool.h"

namespace mpm {

// Height (mm) the torus centre must have over plan point `at` so that the lower half of the ring touches s
// from above; -infinity where s is not under the ring. The drop stops at the largest height over the surface.
inline double drop_height(const Tool& tool, const Vec2& at, const Vec3& s) {
  const double a = hypotenuse(s.x() - at.x(), s.y() - at.y()) - tool.major_radius;
  const double under = tool.minor_radius * tool.minor_radius - a * a;
  return under >= 0 ? s.z() + std::sqrt(under) : -kInfinity;
}

}  // namespace mpm
