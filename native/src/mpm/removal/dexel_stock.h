// The stock as dexels: lines parallel to x, y and z with the intervals of material left on them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/removal/ray_order.h"
#include "mpm/removal/tool_sweep.h"

namespace mpm {

// A block of stock over the box lo..hi (set-up frame, mm). The nodes lie at lo + (index + 1/2) cell; through
// each run three dexels.
struct DexelGrid {
  Vec3 lo, hi;
  double cell;
  std::array<std::size_t, 3> count;  // nodes along x, y and z

  double node(int axis, std::ptrdiff_t index) const { return lo[axis] + (double(index) + 0.5) * cell; }
};

// Fails: std::invalid_argument for an empty box, a cell that is not positive or is so small that there are
//   more than kMaxDexels dexels.
DexelGrid make_dexel_grid(const Vec3& lo, const Vec3& hi, double cell);

inline constexpr double kMaxDexels = 2e8;

// All dexels along one axis; those across are numbered (u, v) by the nodes along axes axis + 1 and axis + 2
// (cyclic). Whole at first: one span from end to end of the box.
//
// Requires: a grid of make_dexel_grid().
// Threads: different tiles may be cut at once; nothing is to be read meanwhile.
class DexelField {
 public:
  DexelField(const DexelGrid& grid, int axis);

  int axis() const { return axis_; }
  std::size_t count_u() const { return count_u_; }
  std::size_t count_v() const { return count_v_; }
  // The material on dexel (u, v): ascending spans of the coordinate along the axis.
  const Span* begin(std::size_t u, std::size_t v) const;
  const Span* end(std::size_t u, std::size_t v) const;

  std::size_t tiles() const { return tiles_.size(); }
  // Takes what is swept out of the dexels of one tile; a cancelled call leaves them as they were.
  void cut_tile(std::size_t tile, const ToolSweep& sweep, const Context& context);

  double length() const;  // mm of material on all dexels together
  std::size_t bytes() const;

 private:
  static constexpr std::size_t kSide = 8;
  static_assert(kSide * kSide == kTileRays);

  struct Tile {
    std::vector<Span> spans;
    std::array<std::uint32_t, kTileRays + 1> start;
  };

  Ray ray(std::size_t u, std::size_t v) const;
  double order_key(const ToolSweep& sweep, std::uint32_t stroke, const Box3& box) const;
  std::size_t tile_of(std::size_t u, std::size_t v) const { return v / kSide * tiles_u_ + u / kSide; }
  static std::size_t slot(std::size_t u, std::size_t v) { return v % kSide * kSide + u % kSide; }

  DexelGrid grid_;
  int axis_;
  std::size_t count_u_, count_v_, tiles_u_;
  std::vector<Tile> tiles_;
};

struct DexelStock {
  explicit DexelStock(const DexelGrid& dexel_grid)
      : grid(dexel_grid), fields{DexelField(grid, 0), DexelField(grid, 1), DexelField(grid, 2)} {}

  DexelGrid grid;
  std::array<DexelField, 3> fields;

  double volume() const { return fields[2].length() * grid.cell * grid.cell; }  // mm^3
};

// Bytes that a stock on this grid takes while each dexel holds one span.
std::size_t dexel_bytes(const DexelGrid& grid);

// Takes everything that the tool sweeps out of the stock.
//
// Requires: stock and sweep in one frame; nobody else uses the stock meanwhile.
// Guarantees: the ends of the spans are exact to kRayEpsilon but for what docs/removal.md says of a stroke's
//   second dip; the same bytes for any number of threads.
// Fails: a cancelled call leaves some tiles cut and the others whole.
void cut_stock(DexelStock& stock, const ToolSweep& sweep, Context& context);

}  // namespace mpm
