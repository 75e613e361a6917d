// SPDX-License-Identifier: Zlib
#pragma once

// The collision checks bound the rounding of every operation, the ledger of water closes to rounding, and a number that
// is none has to be seen before it spreads. With the parts of -ffast-math a compiler may take it that there are no
// infinities and no NaN, and reorder sums. GCC names each part; Clang only the first two; MSVC the whole.
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||             \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__) || \
    defined(_M_FP_FAST)
#error "bullet_wetcloth rests on IEEE arithmetic: compile it without -ffast-math and all of its parts (/fp:fast)"
#endif
