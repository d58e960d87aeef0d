// Proven two-contact positions: first further contact by branch and bound, certified. Note:
// docs/methods/exact.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// gouge_mm: the certificate's tolerance; cell_budget: sub-patches a certificate may look at before it is
// undecided.
std::map<std::string, double> exact_defaults();

// Any spin.
//
// Requires: options.numbers complete, as make_method() hands them over; the model outlives the method.
// Fails: std::invalid_argument for a tool with minor_radius 0 (a sharp edge has no insert to roll on), a
//   gouge_mm that is not positive, and a cell_budget outside 1000 to 1e9.
std::unique_ptr<Method> make_exact(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
