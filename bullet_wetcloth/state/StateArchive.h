// SPDX-License-Identifier: Zlib
#pragma once

#include "bullet_wetcloth/Precision.h"
#include "bullet_wetcloth/state/StateError.h"

#include <LinearMath/btAlignedObjectArray.h>
#include <LinearMath/btTransform.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

class btCollisionObject;
class btCollisionWorld;

namespace wetcloth {
inline namespace WETCLOTH_PRECISION {

/// The values of a state, in their order: one description of a class serves to save it, to check what a stream says
/// against it, and to restore it. So the three cannot disagree.
///
/// A stream is checked in full before anything is restored from it. While checking, nothing that is handed in is
/// changed, and what does not fit throws StateError; while restoring, nothing throws any more. An object's description
/// names its values in the same order each time:
///
///   void Soaking::transferState(StateArchive& archive) {
///     archive.value(m_wetSince);
///     archive.array(m_carry);                        // as long as it is here: another length is refused
///     if (archive.isRestoring()) rebuildFromCarry();
///   }
class WETCLOTH_EXPORT StateArchive {
 public:
  /// Saves the state of objects of this world.
  explicit StateArchive(const btCollisionWorld& world);
  /// Checks a state, and after rewind() restores it.
  StateArchive(const btCollisionWorld& world, std::vector<unsigned char> bytes);

  /// What is handed in is written to the state.
  bool isSaving() const { return m_mode == Mode::save; }
  /// What is handed in is compared with the state, and not changed.
  bool isChecking() const { return m_mode == Mode::check; }
  /// What was handed in so far has its saved values: what was derived from them can be rebuilt.
  bool isRestoring() const { return m_mode == Mode::restore; }

  /// A number, truth value or enumerator.
  template <class T>
  void value(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "name the parts of a structure one by one");
    bytes(&value, sizeof value);
  }
  /// A truth value.
  void value(bool& value);
  /// A vector. Bullet never sets the fourth number of its vectors: with it, equal states would have other bytes.
  void value(btVector3& value) { bytes(value.m_floats, 3 * sizeof(btScalar)); }
  /// A matrix.
  void value(btMatrix3x3& value) { this->value(value[0], value[1], value[2]); }
  /// A transform.
  void value(btTransform& value) {
    this->value(value.getBasis());
    this->value(value.getOrigin());
  }
  /// Several, one after the other.
  template <class T, class... More>
  void value(T& first, More&... more) {
    value(first);
    (value(more), ...);
  }

  /// A number that belongs to a temporary: it is read while checking, too.
  template <class T>
  void local(T& value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    bytes(&value, sizeof value, Target::scratch);
  }
  /// The same of a vector.
  void local(btVector3& value) { bytes(value.m_floats, 3 * sizeof(btScalar), Target::scratch); }

  /// All numbers of an array whose length is that of the object here.
  template <class T, class Allocator>
  void array(std::vector<T, Allocator>& values) {
    each(values, [this](T& element) { value(element); });
  }
  /// The same for elements of a structure: transfer(T&) names the parts of each.
  template <class Array, class Transfer>
  void each(Array& values, const Transfer& transfer) {
    expect(values.size(), "an array's length");
    for (decltype(values.size()) i = 0; i < values.size(); ++i) transfer(values[i]);
  }
  /// An array of any length, which it gets when restored.
  template <class T>
  void growingArray(std::vector<T>& values) {
    growing(values, [this](T& element) { value(element); });
  }
  /// The same for elements of a structure: transfer(T&) names the parts of each.
  template <class Array, class Transfer>
  void growing(Array& values, const Transfer& transfer) {
    growing(values, transfer, [](const auto&) { return true; });
  }
  /// Without the elements that isWorthIt() refuses when they are saved.
  template <class Array, class Transfer, class Predicate>
  void growing(Array& values, const Transfer& transfer, const Predicate& isWorthIt) {
    using Size = decltype(values.size());
    using Element = std::remove_reference_t<decltype(values[0])>;
    std::size_t size = 0;
    for (Size i = 0; isSaving() && i < values.size(); ++i) size += isWorthIt(values[i]) ? 1 : 0;
    size = count(size);
    if (isChecking()) {
      Element element{};
      for (std::size_t i = 0; i < size; ++i) transfer(element);
      return;
    }
    if (isRestoring()) values.resize(static_cast<Size>(size));
    for (Size i = 0; i < values.size(); ++i) {
      if (isRestoring() || isWorthIt(values[i])) transfer(values[i]);
    }
  }
  /// What may be there or not; transfer(T&) names its parts.
  template <class T, class Transfer>
  void optional(std::optional<T>& value, const Transfer& transfer) {
    bool isThere = value.has_value();
    this->value(isThere);
    isThere = m_lastBool;  // while checking nothing is written
    if (isChecking()) {
      T scratch{};
      if (isThere) transfer(scratch);
      return;
    }
    if (isRestoring()) value = isThere ? std::optional<T>(T{}) : std::nullopt;
    if (isThere) transfer(*value);
  }

  /// A place in an array of that size, or -1: the one handed in while saving, the saved one otherwise. Throws
  /// StateError when the saved one is out of range.
  int index(int index, int size, const char* what);
  /// The same where -1 is not allowed.
  int place(int index, int size, const char* what);
  /// How many of something follow. Throws StateError when the stream is too short for so many.
  std::size_t count(std::size_t live);
  /// What must be the same here: throws StateError that names it and both values.
  template <class T>
  void expect(const T& live, const std::string& what) {
    std::int64_t saved = static_cast<std::int64_t>(live);
    std::int64_t found = saved;
    bytes(&found, sizeof found, Target::scratch);
    if (isChecking() && found != saved) {
      fail(what + " is " + std::to_string(saved) + " here and " + std::to_string(found) + " in the saved state");
    }
  }
  /// A text that must be the same here: throws StateError that names it and both.
  void expect(const std::string& live, const std::string& what);

  /// Whether it is an object of the world; one that is gone may be asked for, too.
  bool has(const btCollisionObject* object) const;
  /// An object of the world, or null. One that is not in the world (any more) is saved as null.
  void object(const btCollisionObject*& object);
  /// The same for a pointer to what may change.
  void object(btCollisionObject*& object) {
    const btCollisionObject* found = object;
    this->object(found);
    object = const_cast<btCollisionObject*>(found);
  }

  /// A part whose length is written before it: who reads another length is named in the error.
  template <class Transfer>
  void section(const std::string& name, const Transfer& transfer) {
    const std::size_t begin = openSection();
    transfer();
    closeSection(name, begin);
  }

  /// Throws StateError with this message and the place in the stream.
  [[noreturn]] void fail(const std::string& message) const;

  /// The whole state, once it is saved.
  const std::vector<unsigned char>& bytes() const { return m_bytes; }
  /// From checking to restoring. Throws StateError when the check has left something over.
  void rewind();

 private:
  enum class Mode { save, check, restore };
  enum class Target { live, scratch };

  /// While checking only a scratch target is written.
  void bytes(void* data, std::size_t size, Target target = Target::live);
  std::size_t openSection();
  void closeSection(const std::string& name, std::size_t begin);
  std::size_t left() const { return m_bytes.size() - m_position; }

  const btCollisionWorld& m_world;
  Mode m_mode;
  std::vector<unsigned char> m_bytes;
  std::size_t m_position = 0;
  bool m_lastBool = false;
};

}  // namespace WETCLOTH_PRECISION
}  // namespace wetcloth
