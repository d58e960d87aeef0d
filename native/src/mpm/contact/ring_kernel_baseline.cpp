#include "mpm/contact/ring_kernel.inc"

namespace mpm {

const RingKernel kBaselineRingKernel{bound, quadratic, quarter};

const RingKernel& ring_kernel() {
#ifdef MPM_AVX2
  static const bool wide = __builtin_cpu_supports("avx2");
  if (wide) return kAvx2RingKernel;
#endif
  return kBaselineRingKernel;
}

}  // namespace mpm
