// Compiled with AVX-512 where the compiler has it (native/CMakeLists.txt); empty elsewhere.
#ifdef MPM_AVX512
#define MPM_SIDE_BY_SIDE 2
#include "mpm/contact/ring_kernel.inc"

namespace mpm {

const RingKernel kAvx512RingKernel{bound, quarter};

}  // namespace mpm
#endif
