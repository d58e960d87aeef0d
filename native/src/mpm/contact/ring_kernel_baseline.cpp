#define MPM_SIDE_BY_SIDE 1
#include "mpm/contact/ring_kernel.inc"

namespace mpm {

const RingKernel kBaselineRingKernel{bound, quarter};

const RingKernel& ring_kernel() {
  static const RingKernel& widest = []() -> const RingKernel& {
#ifdef MPM_AVX512
    if (__builtin_cpu_supports("avx512dq")) return kAvx512RingKernel;
#endif
#ifdef MPM_AVX2
    if (__builtin_cpu_supports("avx2")) return kAvx2RingKernel;
#endif
    return kBaselineRingKernel;
  }();
  return widest;
}

}  // namespace mpm
