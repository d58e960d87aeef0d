// Which vector instructions the processor has: the one place that asks. Kernels (native/cmake/kernels.cmake)
// are compiled once for each instruction set, and chosen here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace mpm {

// Each holds those before it.
enum class InstructionSet { baseline, avx2, avx512 };

// The widest that this processor has. It is asked once.
InstructionSet instruction_set();

// Those of a kernel's versions that this processor can run. `versions`: one for each instruction set, from
// the baseline to the widest that the kernel is compiled for.
template <class Kernel, std::size_t kCount>
std::span<const Kernel* const> runnable(const Kernel* const (&versions)[kCount]) {
  return std::span(versions).first(std::min(kCount, std::size_t(instruction_set()) + 1));
}

template <class Kernel, std::size_t kCount>
const Kernel& widest(const Kernel* const (&versions)[kCount]) {
  return *runnable(versions).back();
}

}  // namespace mpm
