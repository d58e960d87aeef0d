// A method run over many points or contacts, in parallel.
#pragma once

#include <span>
#include <vector>

#include "mpm/base/context.h"
#include "mpm/positioning/method.h"

namespace mpm {

struct Placements {
  std::vector<Placement> positions;  // one a point, in the order of the points
  Counters counters;
};

// Every point with the method's own spin.
//
// Guarantees, as all that follow: one position a start, in the order of the starts; the result does not
// depend on the number of threads. What a cancelled context left out is not_computed; the counters are of
// what was done.
Placements place_all(const Method& method, const std::vector<Vec2>& points, Context& context);
// Every point with every spin (radians), point by point: position i * spins.size() + k has spin k. The
// drop over a point is done once.
//
// Fails: std::invalid_argument where the method cannot spin, and for a spin that is not finite.
Placements place_spins(const Method& method,
                       const std::vector<Vec2>& points,
                       std::span<const double> spins,
                       Context& context);
// Every point with a spin of its own.
//
// Fails: std::invalid_argument where the method cannot spin, for a spin that is not finite, and where points
// and spins differ in length.
Placements place_spun(const Method& method,
                      const std::vector<Vec2>& points,
                      std::span<const double> spins,
                      Context& context);
// Every given contact.
//
// Fails: std::invalid_argument where the method has no such entry, for a face that the model does not have,
// parameters that are not finite and a direction that is none.
Placements place_all(const Method& method,
                     const SurfaceModel& model,
                     const std::vector<GivenContact>& contacts,
                     Context& context);

}  // namespace mpm
