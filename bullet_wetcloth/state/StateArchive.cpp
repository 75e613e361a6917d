// SPDX-License-Identifier: Zlib
#include "bullet_wetcloth/state/StateArchive.h"

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include <cstring>
#include <utility>

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

namespace {

// A stream may hold anything: what an error shows of it stays one line of letters.
std::string inQuotes(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  std::string shown = text.substr(0, kLongest);
  for (char& letter : shown) {
    if (letter < ' ' || letter > '~') letter = '?';
  }
  return '"' + shown + (text.size() > kLongest ? "...\"" : "\"");
}

}  // namespace

StateArchive::StateArchive(const btCollisionWorld& world) : m_world(world), m_mode(Mode::save) {}

StateArchive::StateArchive(const btCollisionWorld& world, std::vector<unsigned char> bytes)
    : m_world(world), m_mode(Mode::check), m_bytes(std::move(bytes)) {}

void StateArchive::bytes(void* data, std::size_t size, Target target) {
  if (isSaving()) {
    const auto* begin = static_cast<const unsigned char*>(data);
    m_bytes.insert(m_bytes.end(), begin, begin + size);
    return;
  }
  if (size > left()) fail("the saved state ends too early");
  if (isRestoring() || target == Target::scratch) std::memcpy(data, m_bytes.data() + m_position, size);
  m_position += size;
}

// A byte that is neither 0 nor 1 is no bool of C++.
void StateArchive::value(bool& value) {
  unsigned char byte = value ? 1 : 0;
  bytes(&byte, 1, Target::scratch);
  if (byte > 1) fail("a truth value is " + std::to_string(byte));
  m_lastBool = byte == 1;
  if (!isChecking()) value = m_lastBool;
}

int StateArchive::index(int index, int size, const char* what) {
  std::int32_t found = index;
  bytes(&found, sizeof found, Target::scratch);
  if (found < -1 || found >= size) {
    fail(std::string(what) + " number " + std::to_string(found) + " is not one of " + std::to_string(size));
  }
  return found;
}

int StateArchive::place(int index, int size, const char* what) {
  const int found = this->index(index, size, what);
  if (found < 0) fail(std::string("there is a ") + what + " that is not, or no longer, where it should be");
  return found;
}

std::size_t StateArchive::count(std::size_t live) {
  std::uint64_t found = live;
  bytes(&found, sizeof found, Target::scratch);
  if (!isSaving() && found > left())
    fail("the saved state ends before the " + std::to_string(found) + " things it tells of");
  return static_cast<std::size_t>(found);
}

void StateArchive::expect(const std::string& live, const std::string& what) {
  std::string found(count(live.size()), ' ');
  if (isSaving()) found = live;
  bytes(found.data(), found.size(), Target::scratch);
  if (isChecking() && found != live)
    fail(what + " is " + inQuotes(live) + " here and " + inQuotes(found) + " in the saved state");
}

bool StateArchive::has(const btCollisionObject* object) const {
  const btCollisionObjectArray& objects = m_world.getCollisionObjectArray();
  bool isThere = false;
  for (int i = 0; i < objects.size() && !isThere; ++i) isThere = objects[i] == object;
  return isThere;
}

void StateArchive::object(const btCollisionObject*& object) {
  const btCollisionObjectArray& objects = m_world.getCollisionObjectArray();
  int place = -1;
  if (isSaving()) {
    for (int i = 0; i < objects.size() && place < 0; ++i) place = objects[i] == object ? i : -1;
  }
  place = index(place, objects.size(), "collision object");
  if (isRestoring()) object = place < 0 ? nullptr : objects[place];
}

std::size_t StateArchive::openSection() {
  count(0);
  return isSaving() ? m_bytes.size() : m_position;
}

// The section's length is in the eight bytes before it.
void StateArchive::closeSection(const std::string& name, std::size_t begin) {
  std::uint64_t length = (isSaving() ? m_bytes.size() : m_position) - begin;
  unsigned char* const place = m_bytes.data() + begin - sizeof length;
  if (isSaving()) {
    std::memcpy(place, &length, sizeof length);
    return;
  }
  std::uint64_t saved = 0;
  std::memcpy(&saved, place, sizeof saved);
  if (saved != length) {
    fail(name + " reads " + std::to_string(length) + " bytes here and has " + std::to_string(saved) +
         " in the saved state");
  }
}

void StateArchive::rewind() {
  if (left() > 0) fail("the saved state goes on after its end");
  m_mode = Mode::restore;
  m_position = 0;
}

void StateArchive::fail(const std::string& message) const {
  if (isSaving()) throw StateError(message);
  throw StateError(message + " (at byte " + std::to_string(m_position) + ")");
}

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
