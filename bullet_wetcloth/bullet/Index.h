// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <BulletSoftBody/btSoftBody.h>
#include <LinearMath/btAlignedObjectArray.h>

#include <cstddef>
#include <cstdint>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// Bullet counts with int, the standard library with std::size_t.
inline std::size_t toSize(int i) { return static_cast<std::size_t>(i); }

/// Which of its body's nodes this is.
inline int nodeIndex(const btSoftBody& body, const btSoftBody::Node* node) {
  return static_cast<int>(node - &body.m_nodes[0]);
}

/// The place of an element in an array, by its address; -1 when it is not (or no longer) there.
template <class Element>
int findIndex(const btAlignedObjectArray<Element>& array, const Element* element) {
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
