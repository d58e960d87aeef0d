#define MPM_NET net_baseline
#include "mpm/surface/net_kernel.inc"

namespace mpm {

NetKernel net_kernel() {
#ifdef MPM_AVX2
  if (__builtin_cpu_supports("avx2")) return net_avx2;
#endif
  return net_baseline;
}

}  // namespace mpm
