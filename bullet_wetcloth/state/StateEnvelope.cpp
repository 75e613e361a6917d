// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/StateEnvelope.h"

#include "bullet_wetcloth/state/StateError.h"
#include "bullet_wetcloth/state/StateHash.h"

#include <LinearMath/btScalar.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <istream>
#include <ostream>
#include <string>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

constexpr char kMark[8] = {'w', 'e', 't', 's', 't', 'a', 't', 'e'};
constexpr std::uint32_t kByteOrder = 0x01020304;

struct Header {
  char mark[8];
  std::uint32_t byteOrder;
  std::uint32_t version;
  std::uint32_t bullet;
  std::uint32_t scalarSize;
  std::uint32_t worldKind;
  std::uint32_t reserved;
  std::uint64_t length;
  std::uint64_t hash;  // of what is before it, and of the state
};
static_assert(sizeof(Header) == 48, "the bytes of the header are the format");

Header headerFor(std::uint32_t worldKind) {
  Header header = {};
  std::memcpy(header.mark, kMark, sizeof kMark);
  header.byteOrder = kByteOrder;
  header.version = StateEnvelope::kVersion;
  header.bullet = static_cast<std::uint32_t>(btGetVersion());
  header.scalarSize = sizeof(btScalar);
  header.worldKind = worldKind;
  return header;
}

std::uint64_t hashOf(const Header& header, const std::vector<unsigned char>& state) {
  StateHash hash;
  hash.add(&header, offsetof(Header, hash));
  hash.add(state.data(), state.size());
  return hash.value();
}

void requireSame(const char* what, std::uint32_t found, std::uint32_t wanted) {
  if (found == wanted) return;
  throw StateError("the saved state's " + std::string(what) + " is " + std::to_string(found) + "; here it is " +
                   std::to_string(wanted));
}

void requireFits(const Header& header, std::uint32_t worldKind) {
  const Header wanted = headerFor(worldKind);
  if (std::memcmp(header.mark, kMark, sizeof kMark) != 0) throw StateError("this is no saved state of bullet_wetcloth");
  requireSame("byte order", header.byteOrder, wanted.byteOrder);
  requireSame("format version", header.version, wanted.version);
  requireSame("version of Bullet", header.bullet, wanted.bullet);
  requireSame("precision (bytes of a btScalar)", header.scalarSize, wanted.scalarSize);
  requireSame("kind of world (btDynamicsWorldType)", header.worldKind, wanted.worldKind);
}

// A stream may have been told to throw; what it has read is in its gcount() all the same.
void readInto(std::istream& stream, void* bytes, std::size_t size) {
  try {
    stream.read(static_cast<char*>(bytes), static_cast<std::streamsize>(size));
  } catch (const std::ios_base::failure&) {
  }
}

[[noreturn]] void failTruncated(std::uint64_t found, std::uint64_t wanted) {
  throw StateError("the saved state is cut off: " + std::to_string(found) + " bytes of " + std::to_string(wanted));
}

// In pieces: a length that was damaged must not allocate what no stream holds.
std::vector<unsigned char> readBytes(std::istream& stream, std::uint64_t length) {
  constexpr std::uint64_t kPiece = 1u << 20;
  std::vector<unsigned char> bytes;
  while (bytes.size() < length) {
    const std::size_t before = bytes.size();
    const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, length - before));
    bytes.resize(before + piece);
    readInto(stream, bytes.data() + before, piece);
    const auto found = static_cast<std::uint64_t>(stream.gcount());
    if (found < piece) failTruncated(sizeof(Header) + before + found, sizeof(Header) + length);
  }
  return bytes;
}

}  // namespace

void StateEnvelope::write(std::ostream& stream, std::uint32_t worldKind, const std::vector<unsigned char>& state) {
  Header header = headerFor(worldKind);
  header.length = state.size();
  header.hash = hashOf(header, state);
  bool isWritten = true;
  try {
    stream.write(reinterpret_cast<const char*>(&header), sizeof header);
    stream.write(reinterpret_cast<const char*>(state.data()), static_cast<std::streamsize>(state.size()));
  } catch (const std::ios_base::failure&) {
    isWritten = false;
  }
  if (!isWritten || !stream) throw StateError("the state could not be written to the stream");
}

std::vector<unsigned char> StateEnvelope::read(std::istream& stream, std::uint32_t worldKind) {
  Header header = {};
  readInto(stream, &header, sizeof header);
  const auto found = static_cast<std::size_t>(stream.gcount());
  const std::size_t known = std::min(found, sizeof kMark);
  if (known == 0 || std::memcmp(header.mark, kMark, known) != 0) {
    throw StateError("this is no saved state of bullet_wetcloth");
  }
  if (found < sizeof header) failTruncated(found, sizeof header);
  requireFits(header, worldKind);
  std::vector<unsigned char> state = readBytes(stream, header.length);
  if (hashOf(header, state) != header.hash) throw StateError("the saved state was changed: its hash is another one");
  return state;
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
