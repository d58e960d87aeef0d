// Compiled with AVX-512 where the compiler has it (native/CMakeLists.txt); empty elsewhere. The vectors are
// as wide as AVX2's: there are twice as many registers, and masks of their own.
#ifdef MPM_AVX512
#include "mpm/removal/ring_cut.inc"

namespace mpm {

const RingCutter kAvx512RingCutter{clear, cut};

}  // namespace mpm
#endif
