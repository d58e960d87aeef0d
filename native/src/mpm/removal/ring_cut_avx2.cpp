// Compiled with AVX2 where the compiler has it (native/CMakeLists.txt); empty elsewhere.
#ifdef MPM_AVX2
#include "mpm/removal/ring_cut.inc"

namespace mpm {

const RingCutter kAvx2RingCutter{clear, cut};

}  // namespace mpm
#endif
