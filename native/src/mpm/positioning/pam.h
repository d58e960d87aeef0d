// Principal-axis method, one contact: after Rao, Bedi, Buchal (1996) and Rao, Ismail, Bedi (1997). Note:
// docs/methods/pam.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

std::map<std::string, double> pam_defaults();

// Sampled: nothing is proven. Spin is not part of the method: options.spin must be 0.
std::unique_ptr<Method> make_pam(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
