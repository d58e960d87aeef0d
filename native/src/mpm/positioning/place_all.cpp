#include "mpm/positioning/place_all.h"

#include <cmath>
#include <mutex>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"

namespace mpm {
namespace {

constexpr std::size_t kGrain = 16;  // positions a task

// place(i, out, work) fills the `each` positions of start i.
template <class Place>
Placements place_each(std::size_t starts, std::size_t each, Context& context, const Place& place) {
  Placements result;
  result.positions.resize(starts * each);
  std::mutex adding;
  context.start(starts);
  for_each_range(starts, kGrain, context, [&](std::size_t begin, std::size_t end) {
    Counters work;
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i)
      place(i, std::span(result.positions).subspan(i * each, each), work);
    const std::lock_guard lock(adding);
    result.counters.add(work);
  });
  return result;
}

}  // namespace

Placements place_all(const Method& method, const std::vector<Vec2>& points, Context& context) {
  return place_each(points.size(), 1, context, [&](std::size_t i, auto out, Counters& work) {
    out[0] = method.place(points[i], work);
  });
}

Placements place_spins(const Method& method,
                       const std::vector<Vec2>& points,
                       std::span<const double> spins,
                       Context& context) {
  for (const double spin : spins) require(std::isfinite(spin), "spins_deg: must be finite angles");
  return place_each(points.size(), spins.size(), context, [&](std::size_t i, auto out, Counters& work) {
    const auto dropped = method.drop(points[i], work);
    for (std::size_t k = 0; k < spins.size() && !context.cancelled(); ++k)
      out[k] = dropped->spun(spins[k], work);
  });
}

Placements place_spun(const Method& method,
                      const std::vector<Vec2>& points,
                      std::span<const double> spins,
                      Context& context) {
  require(points.size() == spins.size(), "spins_deg: must be one for each point");
  for (const double spin : spins) require(std::isfinite(spin), "spins_deg: must be finite angles");
  return place_each(points.size(), 1, context, [&](std::size_t i, auto out, Counters& work) {
    out[0] = method.drop(points[i], work)->spun(spins[i], work);
  });
}

Placements place_all(const Method& method,
                     const SurfaceModel& model,
                     const std::vector<GivenContact>& contacts,
                     Context& context) {
  for (const GivenContact& c : contacts) {
    require(c.face < model.faces().size(), "faces: a contact names a face that the model does not have");
    require(std::isfinite(c.u) && std::isfinite(c.v), "uv: parameters must be finite numbers");
    require(c.ring_direction.allFinite() && !c.ring_direction.isZero(0),
            "ring_directions: each must be a finite vector, not zero");
  }
  return place_each(contacts.size(), 1, context, [&](std::size_t i, auto out, Counters& work) {
    out[0] = method.place(contacts[i], work);
  });
}

}  // namespace mpm
