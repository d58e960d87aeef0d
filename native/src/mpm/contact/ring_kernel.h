// The vector kernels behind ClearanceBound: the ring's clearance over many cells at once.
#pragma once

#include "mpm/surface/cell_batch.h"

namespace mpm {

// The ring of a tool at a pose, as plain numbers.
struct RingFrame {
  double center[3], axis[3];  // axis: unit
  double major_radius, minor_radius;
  double rounding;      // mm, taken off every bound
  double lowest_piece;  // mm over the torus centre: the rest of the body begins there ...
  double widest_piece;  // mm from the axis: ... and ends there
};

// What is asked about cells, mm.
struct BoundAsk {
  double enough;    // bounds beyond this are not sharpened
  double proven;    // cells with a lesser bound are open ...
  double searched;  // ... and those whose least clearance is estimated to be less than this
};

// What is known of the ring over each cell of a batch.
struct alignas(32) RingAnswer {
  double lower[kLanes];   // mm: no point of the cell has a smaller signed distance from the ring (nor, where
                          // clear_of_pieces, from the rest of the body)
  double center[kLanes];  // mm: signed distance of the cell's centre from the ring
  double a[kLanes];       // where the bounding quadratic has a minimum inside the cell, in [-1, 1] ...
  double b[kLanes];       // ... NaN where it has none, or nobody looked
  unsigned open;          // a bit a lane: see BoundAsk
  unsigned clear_of_pieces;  // a bit a lane: the whole cell lies at least `enough` below or beside the rest
                             // of the body
};

// Every instruction set gives the same bits: only additions, multiplications, divisions and square roots,
// each rounded.
struct RingKernel {
  // First and second order bounds as ClearanceBound's (docs/methods/exact.md, section "Bound") over the cells
  // of two batches, which may be the same; the second is left out where the first reaches `enough`, or the
  // cell is as large as the tool.
  void (*bound)(const RingFrame& ring,
                const CellBatch& first,
                const CellBatch& second,
                const BoundAsk& ask,
                RingAnswer& first_answer,
                RingAnswer& second_answer);
  // The four quarters of cell `lane` of `whole` by substitution: lane 0 a, b < 0; 1 a > 0; 2 b > 0; 3 both.
  // Their error is the whole's.
  void (*quarter)(const CellBatch& whole, int lane, CellBatch& quarters);
};

namespace baseline {
extern const RingKernel kRingKernel;
}
namespace avx2 {
extern const RingKernel kRingKernel;
}
namespace avx512 {
extern const RingKernel kRingKernel;
}
// For widest() of base/instruction_set.h.
inline constexpr const RingKernel* kRingKernels[] = {
    &baseline::kRingKernel, &avx2::kRingKernel, &avx512::kRingKernel};

}  // namespace mpm
