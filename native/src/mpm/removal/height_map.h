// The stock as heights over a plan rectangle, and the material that a moving tool takes from it.
#pragma once

#include <vector>

#include "mpm/base/context.h"
#include "mpm/path/pose_motion.h"
#include "mpm/tool/tool.h"

namespace mpm {

// Heights (set-up z, mm) at the nodes of a regular grid. It holds what the tool leaves seen from +z:
// undercuts, and the roof that a tilted tool would leave above a side cut, are not in it.
struct HeightMap {
  Vec2 lo;                     // plan position of node (0, 0)
  double cell;                 // mm between nodes
  std::size_t columns, rows;   // nodes along x and y
  std::vector<double> height;  // of node (column, row) at row * columns + column

  double x(std::size_t column) const { return lo.x() + double(column) * cell; }
  double y(std::size_t row) const { return lo.y() + double(row) * cell; }
};

inline constexpr std::size_t kMaxNodes = 100'000'000;

// Uncut stock with its flat top at height `top`; the nodes cover [lo, hi], the last ones on or just past
// `hi`. Throws std::invalid_argument for an empty rectangle, a cell that is not positive or more than
// kMaxNodes nodes.
HeightMap make_stock(const Vec2& lo, const Vec2& hi, double cell, double top);

// The tool's way through the stock (set-up frame).
struct SweptPath {
  std::vector<TipPose> poses;
  std::vector<std::uint8_t>
      removes;  // does the move from pose i - 1 to pose i take material away? [0] is not read
};

struct RemovalOptions {
  double step = 0.25;       // mm, largest motion of any point of the tool between two simulated poses
  double tolerance = 1e-3;  // mm, by which the cutter's ring may be taken too large
};

// Lowers every node to the lowest point of the tool's body (ring, bottom, flutes, shank and holder) above it
// at poses along the removing moves, interpolated `step` apart. The result holds too much material between
// poses, never too little but for `tolerance`: at most step^2 / (8 Ri) on a straight move over flat ground.
// Parallel over rows, the same bytes for any number of threads. A cancelled call leaves the map half done.
// Throws std::invalid_argument for an axis that is not a unit vector from the +z side, arrays of different
// length and options that are not positive.
void remove_material(HeightMap& stock,
                     const Tool& tool,
                     const SweptPath& path,
                     const RemovalOptions& options,
                     Context& context);

}  // namespace mpm
