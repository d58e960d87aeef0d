// Drop, Rotate and Drop: Singh, thesis Waterloo 2020, chapter 3. Note: docs/methods/drd.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// The thesis' discretisation and tolerances where it prints them; the others are named in the note.
std::map<std::string, double> drd_defaults();

// Sampled: nothing is proven. Spin is not part of the method.
//
// Requires: options.numbers complete, as make_method() hands them over; the model outlives the method.
// Fails: std::invalid_argument for a spin that is not 0, counts (rays, refinements, equal_contacts) that are
//   not whole numbers from 2 to 1000, lengths that are not positive, and an inner_half that is not 0 or 1.
std::unique_ptr<Method> make_drd(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
