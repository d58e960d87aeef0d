// Compiled with AVX2 where the compiler has it (native/CMakeLists.txt); empty elsewhere.
#ifdef MPM_AVX2
#define MPM_NET net_avx2
#include "mpm/surface/net_kernel.inc"
#endif
