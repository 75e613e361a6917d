// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// For which processors a loop is compiled. Results are the same, bit for bit: no path multiplies and adds in one
/// operation, and each number is computed in the same order.
enum class InstructionSet {
  baseline,  ///< what the compiler may use on every processor that the program runs on: SSE2 on x86-64
  avx2       ///< of x86-64, where the compiler knows how to tell a function's instructions
};

/// The best that this processor has, or what was forced.
WETCLOTH_EXPORT InstructionSet instructionSet();
/// Forces one, for a comparison; one that the processor lacks is taken for `baseline`. Not while a world steps.
WETCLOTH_EXPORT void forceInstructionSet(InstructionSet set);

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth

// A function with this mark is compiled with AVX2, and what is inlined into it, too.
#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define WETCLOTH_HAS_AVX2 1
#define WETCLOTH_AVX2 __attribute__((target("avx2")))
#define WETCLOTH_INLINE inline __attribute__((always_inline))
#else
#define WETCLOTH_INLINE inline
#endif
