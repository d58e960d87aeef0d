// The rotary readings that one pose allows, and what it costs to go from one to the next.
#pragma once

#include <vector>

#include "mpm/machine/orientation.h"

namespace mpm {

struct RotaryCandidate {
  Vec2 rotary;  // readings
  std::uint8_t branch;
  bool within_limits;
};

// True when readings a whole turn apart may be taken as the same until they are unwound: the axis has no
// limits, or so wide ones that a path does not meet them.
bool is_unwound(const RotaryAxis& axis);

// The same position of the axis, whole turns away, nearest to `near`.
double nearest_turn(double reading, double near);

// Both solutions with all the whole turns that the limits allow (the least violating one where none fits);
// of an unwound axis the turn nearest to its zero offset. Never empty.
std::vector<RotaryCandidate> rotary_candidates(const KinematicChain& chain,
                                               const OrientationSolutions& solutions);

// The change of each rotary reading between two candidates, the short way round for unwound axes.
Vec2 rotary_change(const KinematicChain& chain, const Vec2& from, const Vec2& to);

// Seconds that the slower rotary axis needs for the change; an axis without a velocity turns at 1 rad/s.
double rotary_seconds(const KinematicChain& chain, const Vec2& change);

// True when a reading lies within the limits of its axis.
bool within_limits(const KinematicChain& chain, const Vec2& rotary);

}  // namespace mpm
