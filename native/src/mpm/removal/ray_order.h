// Parallel work on rays in tiles of neighbours, and the order in which strokes are tried on a tile.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/removal/tool_sweep.h"

namespace mpm {

inline constexpr std::size_t kTileRays = 64;

// Numbers of the rays, those whose origins are near each other next to each other (Morton order).
std::vector<std::uint32_t> near_together(const std::vector<Ray>& rays);

// The strokes that may meet `box`, those first that cut deepest at a point in its middle: what they take away need not
// be looked at for the others.
void order_strokes(const ToolSweep& sweep, const Box3& box, const Vec3& point, std::vector<std::uint32_t>& strokes);

}  // namespace mpm
