// Drop, Spin and Tilt by Newton: Sharma, Duvedi, Bedi, Mann, Int J Adv Manuf Technol 115 (2021), appendix;
// and without the spin Drop and Tilt: Duvedi, Bedi, Mann, same journal 95 (2018). Note: docs/methods/dstm.md.
#pragma once

#include "mpm/positioning/method.h"

namespace mpm {

// The paper's numbers where its text prints them; the others are named in the note.
std::map<std::string, double> dstm_defaults();

// Sampled: nothing is proven.
//
// Requires: options.numbers complete, as make_method() hands them over; the model outlives the method.
// Fails: std::invalid_argument for a number out of its range, which the message gives, and, by dtm, for a
//   spin that is not 0.
std::unique_ptr<Method> make_dtm(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);
std::unique_ptr<Method> make_dstm(const SurfaceModel& model, const Tool& tool, const MethodOptions& options);

}  // namespace mpm
