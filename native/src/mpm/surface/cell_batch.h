// Four quadratic cells side by side, in the layout that vector instructions want.
#pragma once

#include "mpm/base/lane_count.h"

namespace mpm {

inline constexpr unsigned kAllLanes = (1u << kLanes) - 1;  // a bit a lane

// Lane k of every array is one QuadraticCell (quadratic_cell.h). Plain numbers only: the kernels that read it
// are compiled for several instruction sets and must not share inline functions with the rest.
struct alignas(32) CellBatch {
  enum Term { center, a, b, aa, ab, bb };  // c, A, B, C, E, F there
  // What the first order needs comes first, side by side in the cache.
  double radius[kLanes];      // mm
  double error[kLanes];       // mm
  double term[6][3][kLanes];  // mm
};

}  // namespace mpm
