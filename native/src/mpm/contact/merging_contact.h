// Second contacts that are about to merge with the first.
#pragma once

#include <optional>

#include "mpm/contact/approach.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

// Near the first contact P the arrival is lowest along a valley that leaves P along the ring; on it the
// arrival b(x), x the distance from P (mm), is smooth with b(0) = the curvature limit, and a second contact
// before that limit is a minimum beside 0. Gives the parameters of that minimum as a parabola through three
// points of the valley sees it, a start for Newton's iteration; none where b has no lower place nearby.
// Where a border of the face holds P the valley is that border; a corner has none. `curvature`: the curvature
// limit, radians. `nearby`: only a minimum not farther than a sixteenth of the cutter's radius is wanted; one
// farther off the judge of the pose sees, as the gap there is no longer all rounding.
std::optional<Vec2> merging_contact(const Tool& tool,
                                    const Tilt& approach,
                                    const Face& face,
                                    const PatchMinimum& first_contact,
                                    double curvature,
                                    bool nearby);

}  // namespace mpm
