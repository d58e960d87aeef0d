// Strip width by spin: for every position the spin that sets the two contacts a wanted distance apart. Note:
// docs/strip.md.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/positioning/place_all.h"
#include "mpm/positioning/spacing_rules.h"

namespace mpm {

struct SpacedPlacements {
  Placements placed;
  std::vector<double> spacing;  // mm, as of contact_spacing
  std::vector<double> nearest;  // mm: of all spins, what comes nearest to the wanted; NaN: no spin gives any
};

// Positions over the points, in their order; points of one pass follow each other and have the same
// pass_index. Every position has the wanted spacing where some spin gives it, else nearly the nearest. Of
// several spins a pass takes the ones that turn its axis least: least sum of squared turns, by dynamic
// programming.
//
// Requires: rules with a unit direction `feed`.
// Guarantees: one position a point, whatever the number of threads.
// Fails: std::invalid_argument where the method cannot spin, points and pass_index differ in length, the
//   wanted spacing is not positive, or there are fewer than 4 samples. A cancelled call computes no position.
SpacedPlacements place_spaced(const Method& method,
                              const std::vector<Vec2>& points,
                              const std::vector<std::int64_t>& pass_index,
                              const SpacingRules& rules,
                              Context& context);

}  // namespace mpm
