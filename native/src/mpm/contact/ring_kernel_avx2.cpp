// Compiled with AVX2 where the compiler has it (native/CMakeLists.txt); empty elsewhere.
#ifdef MPM_AVX2
#include "mpm/contact/ring_kernel.inc"

namespace mpm {

const RingKernel kAvx2RingKernel{bound, quadratic, quarter};

}  // namespace mpm
#endif
