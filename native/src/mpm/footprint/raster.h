// XY-parallel raster footprint: straight passes in the set-up's xy plane (thesis fig. 2.3).
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/base/types.h"

namespace mpm {

// Where in plan the tool is to stand: points in the order they are visited, grouped in passes.
struct Footprint {
  std::vector<Vec2> points;
  std::vector<std::uint32_t> pass;  // of each point, non-decreasing from 0
};

struct RasterOptions {
  double direction = kPi / 2;  // feed direction from the x axis, radians; the side step goes to its right
  double side_step = 1.0;      // mm between passes
  double forward_step = 1.0;   // mm between points of a pass
  double margin = 0.0;         // mm added round the rectangle (negative: taken off)
  bool zigzag = false;         // every second pass runs backwards
};

inline constexpr std::size_t kMaxPositions = 10'000'000;

// Passes over the rectangle [lo, hi] of the plane, which is turned with the feed direction: its first corner
// starts the first pass; the last pass and the last point of a pass lie on the far border even when the step
// does not divide the width (thesis section 5.1: passes at x = 0, 18 ... 144, 150).
//
// Fails: std::invalid_argument for steps that are not positive or give more than kMaxPositions points, a
//   rectangle that is empty or that a negative margin takes off, and numbers that are not finite.
Footprint raster(const Vec2& lo, const Vec2& hi, const RasterOptions& options);

}  // namespace mpm
