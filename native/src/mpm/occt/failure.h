// OpenCASCADE's failures in our terms.
#pragma once

#include <Standard_Failure.hxx>
#include <stdexcept>
#include <string>

namespace mpm::occt {

// Runs `work`; what goes wrong in it, ours or OpenCASCADE's, becomes one std::invalid_argument line "<what>:
// <why>".
template <class Work>
auto translating_failures(const std::string& what, const Work& work) {
  try {
    return work();
  } catch (const std::invalid_argument& e) {
    throw std::invalid_argument(what + ": " + e.what());
  } catch (const Standard_Failure& e) {
    throw std::invalid_argument(what + ": the geometry kernel failed: " + e.DynamicType()->Name() + " " +
                                e.GetMessageString());
  }
}

}  // namespace mpm::occt
