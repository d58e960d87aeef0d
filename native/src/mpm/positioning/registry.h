// The positioning methods by name.
#pragma once

#include <vector>

#include "mpm/positioning/method.h"

namespace mpm {

struct MethodInfo {
  const char* name;
  const char* guarantee;                  // "sampled" or "proven"
  bool spins;                             // has Method::drop, and takes a spin
  std::map<std::string, double> numbers;  // option names and the source's defaults
  std::unique_ptr<Method> (*make)(const SurfaceModel&, const Tool&, const MethodOptions&);
};

// All there are, in the order in which they are listed to a user; one's own is added in registry.cpp.
//
// Guarantees: never empty; made at the first call, and from then on the same, references into it included.
// Threads: may be called from any, the first call too.
const std::vector<MethodInfo>& methods();

// The method called `name`, made ready for one tool on one model; what `options` leaves open are the method's
// defaults.
//
// Requires: model and tool outlive the method.
//
// Fails: std::invalid_argument for an unknown method or option, or a value that makes no sense: a tilt_max
// that is not between 0 and a quarter turn, a spin that is not finite or not 0 where the method cannot spin,
// a number out of the range that its method names.
std::unique_ptr<Method> make_method(const std::string& name,
                                    const SurfaceModel& model,
                                    const Tool& tool,
                                    MethodOptions options);

}  // namespace mpm
