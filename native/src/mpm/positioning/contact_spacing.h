// Strip width by spin: for every position the spin that sets the two contacts a wanted distance apart. Note:
// docs/strip.md.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/positioning/method.h"

namespace mpm {

enum class SpacingMeasure : std::uint8_t {
  across,  // seen along the feed: what is left of Q - P without its part along `feed`
  direct,  // |Q - P|
};
inline constexpr std::array kSpacingMeasureNames = {"across", "direct"};

struct SpacingRules {
  double wanted = 0;  // mm, positive
  SpacingMeasure measure = SpacingMeasure::across;
  Vec3 feed = Vec3::UnitX();  // unit direction of the passes, set-up frame
  double axis_max = kPi / 4;  // radians between the axis and +z
  int samples = 36;           // spins looked at on the circle before any is refined
};

// Distance (mm) of the two contacts; 0 where they coincide (curvature_matched), NaN where there is no second
// one.
double contact_spacing(const Placement& placement, const SpacingRules& rules);

struct SpacedPlacements {
  Placements placed;
  std::vector<double> spacing;  // mm, as of contact_spacing
  std::vector<double>
      nearest;  // mm: of all spins, what comes nearest to the wanted spacing; NaN: no spin gives any
};

// A miss within this part of the wanted spacing is none.
inline constexpr double kSpacingTolerance = 0.01;

// Positions over the points, in their order; points of one pass follow each other and have the same
// pass_index. Every position has the wanted spacing where some spin gives it, else nearly the nearest. Of
// several spins a pass takes the ones that turn its axis least: least sum of squared turns, by dynamic
// programming. The result does not depend on the number of threads. Throws std::invalid_argument where the
// method cannot spin.
SpacedPlacements place_spaced(const Method& method,
                              const std::vector<Vec2>& points,
                              const std::vector<std::int64_t>& pass_index,
                              const SpacingRules& rules,
                              Context& context);

}  // namespace mpm
