// Principal-axis method, one contact: after Rao, Bedi, Buchal (1996) and Rao, Ismail, Bedi (1997). Note:
// docs/methods/pam.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// phi_divisions, theta_divisions, gouge_mm: of the gouge check, as dstm's; step_deg: by which a tilt that
// gouges is taken back, ours.
std::map<std::string, double> pam_defaults();

// Sampled: nothing is proven. Spin is not part of the method.
//
// Requires: options.numbers complete, as make_method() hands them over; the model outlives the method.
// Fails: std::invalid_argument for a spin that is not 0, divisions that are not whole numbers from 1 to 4096,
//   and a gouge_mm or step_deg that is not positive.
std::unique_ptr<Method> make_pam(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
