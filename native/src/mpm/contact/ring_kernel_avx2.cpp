// Compiled with AVX2 where the compiler has it (native/CMakeLists.txt); empty elsewhere.
#ifdef MPM_AVX2
#define MPM_SIDE_BY_SIDE 1
#include "mpm/contact/ring_kernel.inc"

namespace mpm {

const RingKernel kAvx2RingKernel{bound, quarter};

}  // namespace mpm
#endif
