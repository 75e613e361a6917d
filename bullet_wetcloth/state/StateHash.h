// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstddef>
#include <cstdint>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// FNV-1a, 64 bits (Fowler, Noll & Vo 1991): a single changed byte always changes it, since each round is a bijection.
class StateHash {
 public:
  /// These bytes more.
  void add(const void* bytes, std::size_t count) {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    for (std::size_t i = 0; i < count; ++i) m_value = (m_value ^ byte[i]) * 0x100000001b3u;
  }
  /// The hash of all bytes so far.
  std::uint64_t value() const { return m_value; }

 private:
  std::uint64_t m_value = 0xcbf29ce484222325u;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
