// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

namespace pictures {

/// Appends numbers to bytes, lowest byte first on every machine.
inline void putByte(std::string& bytes, std::uint32_t value) { bytes += static_cast<char>(value & 0xFFU); }

inline void putUint32(std::string& bytes, std::uint32_t value) {
  for (unsigned shift = 0; shift < 32; shift += 8) putByte(bytes, value >> shift);
}

inline void putUint64(std::string& bytes, std::uint64_t value) {
  putUint32(bytes, static_cast<std::uint32_t>(value));
  putUint32(bytes, static_cast<std::uint32_t>(value >> 32U));
}

inline void putInt32(std::string& bytes, int value) { putUint32(bytes, static_cast<std::uint32_t>(value)); }

inline void putFloat(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  static_assert(sizeof bits == sizeof value, "IEEE 754 single precision");
  std::memcpy(&bits, &value, sizeof bits);
  putUint32(bytes, bits);
}

inline void putDouble(std::string& bytes, double value) {
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof value, "IEEE 754 double precision");
  std::memcpy(&bits, &value, sizeof bits);
  putUint64(bytes, bits);
}

}  // namespace pictures
