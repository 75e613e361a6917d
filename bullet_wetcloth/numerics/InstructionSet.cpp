// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/numerics/InstructionSet.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

InstructionSet best() {
#ifdef WETCLOTH_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

InstructionSet& chosen() {
  static InstructionSet set = best();
  return set;
}

}  // namespace

InstructionSet instructionSet() { return chosen(); }

void forceInstructionSet(InstructionSet set) { chosen() = set == InstructionSet::baseline ? set : best(); }

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
