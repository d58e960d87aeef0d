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

// All there are, in the order in which they are listed to a user.
const std::vector<MethodInfo>& methods();

// The method called `name`, made ready for one tool on one model; what `options` leaves open are the method's
// defaults.
//
// Requires: model and tool outlive the method.
//
// Fails: std::invalid_argument for an unknown method or option, or a value that makes no sense.
std::unique_ptr<Method> make_method(const std::string& name,
                                    const SurfaceModel& model,
                                    const Tool& tool,
                                    MethodOptions options);

}  // namespace mpm
