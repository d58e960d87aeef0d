// The least arrival of an approach on one face, near where a search starts.
#pragma once

#include "mpm/contact/approach.h"
#include "mpm/surface/surface_model.h"

namespace mpm {

struct Arrival {
  double x = kInfinity;
  double u = kNaN, v = kNaN;
  Vec3 s = Vec3::Constant(kNaN);
  bool on_border_u = false,
       on_border_v = false;  // held by the border u = const (v = const) of its patch, not tangent
  int newton_steps = 0;
};

// Local minimum of the arrival over `face` by Newton's iteration with exact derivatives, kept inside the
// Bézier patch it is in and handed to the neighbour where it leaves it; on a crease or a face's edge the
// contact stays there. The result's arrival is never later than the start's. Outside the trim the start
// itself is improved along the trimming polygon.
template <class Approach>
Arrival first_arrival(const Tool& tool, const Approach& approach, const Face& face, double u, double v);

extern template Arrival first_arrival(const Tool&, const Drop&, const Face&, double, double);
extern template Arrival first_arrival(const Tool&, const Tilt&, const Face&, double, double);

}  // namespace mpm
