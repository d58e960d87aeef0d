// Vertical and Circular Ray Firing: Singh, thesis Waterloo 2020, chapter 4. Note: docs/methods/vcrf.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// The thesis' defaults: divisions 32, rounds 4, window_factor 1.5.
std::map<std::string, double> vcrf_defaults();

// Sampled: nothing is proven. Spin is not part of the method.
//
// Requires: options.numbers complete, as make_method() hands them over; the model outlives the method.
// Fails: std::invalid_argument for a spin that is not 0, divisions or rounds that are not whole numbers from
//   1 to 4096, and a window_factor that is not positive.
std::unique_ptr<Method> make_vcrf(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
