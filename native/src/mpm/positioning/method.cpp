#include "mpm/positioning/method.h"

#include <cmath>
#include <mutex>

#include "mpm/base/error.h"
#include "mpm/base/parallel.h"
#include "mpm/gouge/clearance_sampler.h"
#include "mpm/positioning/drd.h"
#include "mpm/positioning/dstm.h"
#include "mpm/positioning/exact.h"
#include "mpm/positioning/pam.h"
#include "mpm/positioning/vcrf.h"

namespace mpm {
namespace {

constexpr std::size_t kGrain = 16;  // positions a task

std::string names_of(const std::vector<MethodInfo>& all) {
  std::string names;
  for (const MethodInfo& m : all) names += (names.empty() ? "" : ", ") + std::string(m.name);
  return names;
}

}  // namespace

const std::vector<MethodInfo>& methods() {
  static const std::vector<MethodInfo> all{{"exact", "proven", true, exact_defaults(), make_exact},
                                           {"vcrf", "sampled", false, vcrf_defaults(), make_vcrf},
                                           {"drd", "sampled", false, drd_defaults(), make_drd},
                                           {"dtm", "sampled", false, dstm_defaults(), make_dtm},
                                           {"dstm", "sampled", true, dstm_defaults(), make_dstm},
                                           {"pam", "sampled", false, pam_defaults(), make_pam}};
  return all;
}

std::unique_ptr<Method> make_method(const std::string& name,
                                    const SurfaceModel& model,
                                    const Tool& tool,
                                    MethodOptions options) {
  require(std::isfinite(options.tilt_max) && options.tilt_max > 0 && options.tilt_max < kPi / 2,
          "tilt_max_deg must be more than 0 and less than 90");
  require(std::isfinite(options.spin), "spin_deg must be a finite angle");
  for (const MethodInfo& m : methods()) {
    if (name != m.name) continue;
    std::map<std::string, double> numbers = m.numbers;
    for (const auto& [key, value] : options.numbers) {
      require(numbers.contains(key), "method " + name + " has no option '" + key + "'");
      numbers[key] = value;
    }
    options.numbers = std::move(numbers);
    return m.make(model, tool, options);
  }
  throw std::invalid_argument("unknown method '" + name + "'; there are: " + names_of(methods()));
}

Placement Method::place(const GivenContact&, Counters&) const {
  throw std::invalid_argument("this method cannot start from given contacts; exact can");
}

std::unique_ptr<DroppedTool> Method::drop(const Vec2&, Counters&) const {
  throw std::invalid_argument("spin_deg: this method cannot spin; exact and dstm can");
}

namespace {

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

void judge_by_sampling(const SurfaceModel& model,
                       const Tool& tool,
                       Placements& placements,
                       Context& context) {
  const ClearanceSampler sampler(model, tool);
  auto& positions = placements.positions;
  context.start(positions.size());
  for_each_range(positions.size(), kGrain, context, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && !context.cancelled(); ++i)
      if (positions[i].pose.axis.allFinite())
        positions[i].clearance_hi = sampler(positions[i].pose, tool.radius()).distance;
  });
}

}  // namespace mpm
