#include "mpm/base/instruction_set.h"

namespace mpm {
namespace {

InstructionSet ask_processor() {
#if defined(__x86_64__) || defined(__i386__)
  if (!__builtin_cpu_supports("avx2")) return InstructionSet::baseline;
  return __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") ? InstructionSet::avx512
                                                                                  : InstructionSet::avx2;
#else
  return InstructionSet::baseline;
#endif
}

}  // namespace

InstructionSet instruction_set() {
  static const InstructionSet widest = ask_processor();
  return widest;
}

}  // namespace mpm
