// How far the tool may tilt before its curvature along the ring no longer clears the surface at the first
// contact.
#pragma once

#include "mpm/contact/first_arrival.h"

namespace mpm {

// Tilt (radians) at which the relative second fundamental form of tool and surface at the first contact stops
// being positive semidefinite; +infinity where it never does, at most 0 where it is not even before the tilt.
// The form at tilt b is A + k(b) p p^T with A the surface's bending plus the minor circle's 1/Ri and k the
// ring's curvature along u1: singular at k* = -det A / (p^T adj(A) p), and k(b) = cos / (Ro + Ri cos) with
// cos = n.v1 cos b - n.w1 sin b. A contact held by a border is limited by the curvature along the border
// only; at a corner nothing limits.
//
// Requires: minor_radius > 0; `insert` touches at `at`, which is the point of `first_contact`.
double curvature_limit(const Tool& tool,
                       const Insert& insert,
                       const SurfacePoint& at,
                       const PatchMinimum& first_contact);

}  // namespace mpm
