// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/numerics/InstructionSet.h"
#include "bullet_wetcloth/numerics/Lanes.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

#ifdef WETCLOTH_HAS_AVX2
template <class Kernel>
WETCLOTH_AVX2 void runWithAvx2(const Kernel& kernel) {
  kernel.template run<WideLanes>();
}
#endif

/// Calls kernel.run<Lanes>(), a WETCLOTH_INLINE function, with the widest lanes of instructionSet().
template <class Kernel>
void runOnBestLanes(const Kernel& kernel) {
#ifdef WETCLOTH_HAS_AVX2
  if (instructionSet() == InstructionSet::avx2) return runWithAvx2(kernel);
#endif
  kernel.template run<NarrowLanes>();
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
