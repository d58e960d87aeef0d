// The vector kernels that cut rays with the tool's ring: four rays at once during one stroke.
#pragma once

#include "mpm/base/lane_count.h"

namespace mpm {

// The ring during a stroke (stroke.h), as plain numbers: the kernels are compiled for several instruction
// sets and must not share inline functions with the rest.
struct RingStroke {
  struct Pose {
    double center[3], axis[3], center_rate[3], axis_rate[3];
  };
  Pose ends[2];
  double tip[3], travel[3], axis[3], side[3];
  double angle, length;
  double major, minor;  // radii, mm
};

// Four rays, and how far material reaches on each.
struct alignas(32) RayBatch {
  double origin[3][kLanes], direction[3][kLanes];  // direction: unit
  double height[kLanes];                           // mm from the origin
};

// Four bundles of rays that lie near each other: of each the upper end of its middle ray, and how far the
// other rays' upper ends are from it (mm, in all and along the middle ray) and their directions from its
// (length of the difference).
struct alignas(32) BundleBatch {
  double top[3][kLanes], direction[3][kLanes];
  double radius[kLanes], along[kLanes], spread[kLanes];
};

// A bit a lane. Lanes in neither are done: the ring sweeps nothing of -below <= t <= height.
struct RingCut {
  int lowered;    // the height is where the ring's swept volume begins; above, it reaches up to the lesser of
                  // the old height and 0 at least
  int undecided;  // the kernel does not know; the height is as before
};

// The source of the steps is docs/removal.md, "Four rays at once". All kernels give the same bits.
struct RingCutter {
  // A bit a bundle: the ring keeps clear, during the whole stroke, of the upper ends of all its rays, and all
  // their lower points lie farther from it.
  int (*clear)(const RingStroke& ring, const BundleBatch& bundles);
  RingCut (*cut)(const RingStroke& ring, RayBatch& rays, double below);
};

namespace baseline {
extern const RingCutter kRingCutter;
}
namespace avx2 {
extern const RingCutter kRingCutter;
}
namespace avx512 {
extern const RingCutter kRingCutter;
}
// For widest() of base/instruction_set.h.
inline constexpr const RingCutter* kRingCutters[] = {
    &baseline::kRingCutter, &avx2::kRingCutter, &avx512::kRingCutter};

}  // namespace mpm
