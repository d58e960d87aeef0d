#include "mpm/machine/rotary_candidates.h"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kTurn = 2 * kPi;
// Limits further apart than this are not worth a state per turn in the search; what leaves them is found
// afterwards.
constexpr double kWideLimits = 8 * kTurn;
// A reading over its limit by no more than this (radians, 1e-7 degrees) is rounding of the limit in degrees.
constexpr double kLimitSlack = 2e-9;
constexpr double kDefaultVelocity = 1.0;  // rad/s

bool within(const RotaryAxis& axis, double reading) {
  return reading >= axis.min_limit - kLimitSlack && reading <= axis.max_limit + kLimitSlack;
}

// Whole turns of the reading that fit the limits; if none does, the one that violates them least.
std::vector<double> turns_of(const RotaryAxis& axis, double reading) {
  if (is_unwound(axis)) return {nearest_turn(reading, axis.zero_offset)};
  std::vector<double> result;
  const double first = std::ceil((axis.min_limit - kLimitSlack - reading) / kTurn);
  for (double r = reading + first * kTurn; within(axis, r); r += kTurn) result.push_back(r);
  if (result.empty()) result.push_back(nearest_turn(reading, 0.5 * (axis.min_limit + axis.max_limit)));
  return result;
}

}  // namespace

bool is_unwound(const RotaryAxis& axis) { return !(axis.max_limit - axis.min_limit < kWideLimits); }

double nearest_turn(double reading, double near) {
  return reading -
         kTurn * std::round((reading - near) / kTurn);  // unchanged, bit for bit, when it is the nearest
}

std::vector<RotaryCandidate> rotary_candidates(const KinematicChain& chain,
                                               const OrientationSolutions& solutions) {
  std::vector<RotaryCandidate> result;
  for (std::uint8_t branch = 0; branch < 2; ++branch)
    for (double first : turns_of(chain.rotary[0], solutions.rotary[branch][0]))
      for (double second : turns_of(chain.rotary[1], solutions.rotary[branch][1])) {
        const Vec2 rotary(first, second);
        result.push_back({rotary, branch, within_limits(chain, rotary)});
      }
  return result;
}

Vec2 rotary_change(const KinematicChain& chain, const Vec2& from, const Vec2& to) {
  Vec2 change = to - from;
  for (int k = 0; k < 2; ++k)
    if (is_unwound(chain.rotary[k])) change[k] = std::remainder(change[k], kTurn);
  return change;
}

double rotary_seconds(const KinematicChain& chain, const Vec2& change) {
  double seconds = 0;
  for (int k = 0; k < 2; ++k) {
    const double velocity = chain.rotary[k].max_velocity;
    seconds =
        std::max(seconds, std::abs(change[k]) / (std::isfinite(velocity) ? velocity : kDefaultVelocity));
  }
  return seconds;
}

bool within_limits(const KinematicChain& chain, const Vec2& rotary) {
  return within(chain.rotary[0], rotary[0]) && within(chain.rotary[1], rotary[1]);
}

}  // namespace mpm
