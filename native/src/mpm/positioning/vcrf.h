// Vertical and Circular Ray Firing: Singh, thesis Waterloo 2020, chapter 4. Note: docs/methods/vcrf.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// The thesis' defaults: divisions 32, rounds 4, window_factor 1.5.
std::map<std::string, double> vcrf_defaults();

// Sampled: nothing is proven. Spin is not part of the method: options.spin must be 0.
std::unique_ptr<Method> make_vcrf(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
