// What a wanted distance of the two contacts means, and which distance a position has.
#pragma once

#include <array>
#include <cstdint>

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

// A miss within this part of the wanted spacing is none.
inline constexpr double kSpacingTolerance = 0.01;

}  // namespace mpm
