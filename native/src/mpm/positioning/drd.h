// Drop, Rotate and Drop: Singh, thesis Waterloo 2020, chapter 3. Note: docs/methods/drd.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// The thesis' discretisation and tolerances where it prints them; the others are named in the note.
std::map<std::string, double> drd_defaults();

// Sampled: nothing is proven. Spin is not part of the method: options.spin must be 0.
std::unique_ptr<Method> make_drd(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
