// How many numbers the vector kernels work on side by side.
#pragma once

namespace mpm {

inline constexpr int kLanes = 4;

}  // namespace mpm
