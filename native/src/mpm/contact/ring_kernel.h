// The vector kernels behind ClearanceBound: the ring's clearance over four cells at once.
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

// What is known of the ring over each of four cells.
struct alignas(32) RingAnswer {
  double lower[kLanes];   // mm: no point of the cell has a smaller signed distance from the ring (nor, where
                          // clear_of_pieces, from the rest of the body)
  double center[kLanes];  // mm: signed distance of the cell's centre from the ring
  double a[kLanes];       // where the bounding quadratic has a minimum inside the cell, in [-1, 1] ...
  double b[kLanes];       // ... NaN where it has none, or nobody looked
  int open;               // a bit a lane: see BoundAsk
  int clear_of_pieces;  // a bit a lane: the whole cell lies at least `enough` below or beside the rest of the
                        // body
};

// A lower bound of the ring's clearance over each of four cells:
//   f + g1 a + g2 b + h11 a^2 + h12 a b + h22 b^2 + aaa a^3 + aab a^2 b + abb a b^2 + bbb b^3
//     - loss max(|a|, |b|)^3
// for some a, b in [-1, 1] at every point of the cell; the cell's centre has a = b = 0. f is NaN for a cell
// that does not keep off the tool axis.
struct alignas(32) RingQuadratic {
  double f[kLanes];  // mm, as all of them
  double g1[kLanes], g2[kLanes], h11[kLanes], h12[kLanes], h22[kLanes];
  double aaa[kLanes], aab[kLanes], abb[kLanes], bbb[kLanes], loss[kLanes];
  // a and b are the cell's own parameters but for shift max(|a|, |b|)^2 at most; the first-order terms with
  // the cell's own in the place of a and b are thereby greater by (|g1| + |g2|) shift max(|a|, |b|)^2 at
  // most.
  double shift[kLanes];
};

// Every instruction set gives the same bits: only additions, multiplications, divisions and square roots,
// each rounded.
struct RingKernel {
  // First and second order bounds as ClearanceBound's (docs/methods/exact.md, section "Bound"); the second is
  // left out where the first reaches `enough` in every lane, or the cells are as large as the tool.
  void (*bound)(const RingFrame& ring, const CellBatch& cells, const BoundAsk& ask, RingAnswer& answer);
  // The second-order bound itself. Requires the cells' error to be at most error max(|a|, |b|)^3 where a, b
  // are the cell's own parameters.
  void (*quadratic)(const RingFrame& ring, const CellBatch& cells, RingQuadratic& answer);
  // The four quarters of cell `lane` of `whole` by substitution: lane 0 a, b < 0; 1 a > 0; 2 b > 0; 3 both.
  // Their error is the whole's.
  void (*quarter)(const CellBatch& whole, int lane, CellBatch& quarters);
};

// The widest that this processor has.
const RingKernel& ring_kernel();

extern const RingKernel kBaselineRingKernel;
#ifdef MPM_AVX2
extern const RingKernel kAvx2RingKernel;
#endif

}  // namespace mpm
