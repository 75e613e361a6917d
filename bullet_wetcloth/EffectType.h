// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Tells classes of effects apart by the address of `tag`, without the RTTI that an application may be compiled
/// without.
///
/// The tag is as visible as E is: that of an exported class is the same in each shared library, that of a hidden one is
/// its library's own. It is no constant, so that no linker folds the tags of two classes into one.
template <class E>
struct [[gnu::visibility("default")]] EffectType {
  /// Only its address counts.
  static inline char tag = 0;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
