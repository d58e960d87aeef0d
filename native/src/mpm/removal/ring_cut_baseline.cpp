#include "mpm/removal/ring_cut.inc"

namespace mpm {

const RingCutter kBaselineRingCutter{clear, cut};

const RingCutter& ring_cutter() {
#ifdef MPM_AVX2
  static const bool wide = __builtin_cpu_supports("avx2");
  if (wide) return kAvx2RingCutter;
#endif
  return kBaselineRingCutter;
}

}  // namespace mpm
