#include "mpm/removal/ring_cut.inc"

namespace mpm {

const RingCutter kBaselineRingCutter{clear, cut};

const RingCutter& ring_cutter() {
  static const RingCutter& widest = []() -> const RingCutter& {
#ifdef MPM_AVX512
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) return kAvx512RingCutter;
#endif
#ifdef MPM_AVX2
    if (__builtin_cpu_supports("avx2")) return kAvx2RingCutter;
#endif
    return kBaselineRingCutter;
  }();
  return widest;
}

}  // namespace mpm
