// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"

#include <cstdint>
#include <iosfwd>
#include <vector>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// What a saved state is wrapped in: a mark, the version of the format and of Bullet, the precision, the kind of world,
/// the length and a hash of it all.
struct StateEnvelope {
  static constexpr std::uint32_t kVersion = 13;  ///< of the format

  /// Writes the state; throws StateError when the stream fails.
  static void write(std::ostream& stream, std::uint32_t worldKind, const std::vector<unsigned char>& state);
  /// Reads one, and what follows it in the stream stays there. Throws StateError that names what is wrong: not a saved
  /// state, of another version, precision, byte order or kind of world, cut off, or changed.
  static std::vector<unsigned char> read(std::istream& stream, std::uint32_t worldKind);
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
