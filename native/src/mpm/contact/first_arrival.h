// The least arrival of an approach on one face, near where a search starts.
#pragma once

#include "mpm/contact/approach.h"
#include "mpm/contact/patch_search.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

// Local minimum of the arrival over `face` by Newton's iteration with exact derivatives, kept inside the
// Bézier patch it is in and handed to the neighbour where it leaves it; on a crease or a face's edge the
// contact stays there. The result's arrival is never later than the start's. Outside the trim the start
// itself is improved along the trimming polygon.
//
// Fails: an infinite value where neither the start nor, of a trimmed face, its polygon ever meets the ring.
template <Approach A>
PatchMinimum first_arrival(const Tool& tool, const A& approach, const Face& face, double u, double v);

extern template PatchMinimum first_arrival(const Tool&, const Drop&, const Face&, double, double);
extern template PatchMinimum first_arrival(const Tool&, const Tilt&, const Face&, double, double);

}  // namespace mpm
