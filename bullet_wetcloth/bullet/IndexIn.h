// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <LinearMath/btAlignedObjectArray.h>

#include <cstdint>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The place of an element in an array, by its address; -1 when it is not (or no longer) there.
template <class Element>
int indexIn(const btAlignedObjectArray<Element>& array, const Element* element) {
  if (array.size() == 0) return -1;
  const auto first = reinterpret_cast<std::uintptr_t>(&array[0]);
  const auto address = reinterpret_cast<std::uintptr_t>(element);
  const std::uintptr_t count = static_cast<std::uintptr_t>(array.size());
  if (address < first || address >= first + count * sizeof(Element)) return -1;
  if ((address - first) % sizeof(Element) != 0) return -1;
  return static_cast<int>((address - first) / sizeof(Element));
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
