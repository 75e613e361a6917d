// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/SceneKeys.h"

#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace command {

using Json = nlohmann::json;

/// What a number may be. `text` completes the sentence "must be ...".
struct Range {
  double low;
  double high;
  bool lowIsIn;
  const char* text;
  bool highIsIn = true;

  static Range finite() { return {-3.4e38, 3.4e38, true, "a finite number that float32 can hold"}; }
  static Range positive() { return {0, 3.4e38, false, "finite and > 0"}; }
  static Range notNegative() { return {0, 3.4e38, true, "finite and >= 0"}; }
  /// Of a place, and of all else that has no range of its own: command/scene/Farthest.h.
  static Range coordinate() { return {-1e8, 1e8, true, "in [-1e8, 1e8]"}; }
  /// Of a velocity: WindField::fastest.
  static Range velocity() { return {-1e6, 1e6, true, "in [-1e6, 1e6]"}; }
  static Range speed() { return {0, 1e6, true, "in [0, 1e6]"}; }
  static Range fraction() { return {0, 1, true, "in [0, 1]"}; }
  static Range positiveFraction() { return {0, 1, false, "in (0, 1]"}; }

  bool contains(double value) const {
    return (lowIsIn ? value >= low : value > low) && (highIsIn ? value <= high : value < high);
  }
};

/// Reads a JSON file. Throws InputError, with line and column, when it is missing, empty, not JSON, or has an
/// object with the same key twice.
Json loadJson(const std::string& file);

/// A place in a JSON document. It knows its file and JSON pointer, so every complaint about it names both, the
/// value, and what is allowed.
class JsonCursor {
 public:
  JsonCursor(const Json& value, std::string file, std::string pointer = "")
      : m_value(&value), m_file(std::move(file)), m_pointer(std::move(pointer)) {}

  const std::string& file() const { return m_file; }
  const std::string& pointer() const { return m_pointer; }
  const Json& json() const { return *m_value; }
  bool isObject() const { return m_value->is_object(); }
  bool isArray() const { return m_value->is_array(); }
  bool isText() const { return m_value->is_string(); }

  /// Says that this is an object with these keys and no others. Only they can be asked for afterwards.
  void expectObject(const KeyTable& keys);
  /// The value of a key, or nothing.
  std::optional<JsonCursor> find(const std::string& key) const;
  /// The value of a key that must be there.
  JsonCursor at(const std::string& key) const;
  /// Exactly one of the keys must be there; returns which.
  std::string exactlyOneOf(const std::vector<std::string>& keys) const;
  std::vector<JsonCursor> elements() const;

  double number(const Range& range) const;
  int integer(int low, int high) const;
  bool boolean() const;
  std::string text() const;
  std::array<double, 3> triple(const Range& range = Range::finite()) const;

  /// One of the named values.
  template <class Value>
  Value choice(const std::vector<std::pair<std::string, Value>>& choices) const {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) names.push_back(name);
    return choices[indexOf(text(), names)].second;
  }

  /// "FILE: POINTER = VALUE: must be ALLOWED"
  [[noreturn]] void reject(const std::string& allowed) const;
  /// "FILE: POINTER = VALUE: COMPLAINT"
  [[noreturn]] void complain(const std::string& complaint) const;

 private:
  std::size_t indexOf(const std::string& word, const std::vector<std::string>& names) const;

  const Json* m_value;
  std::string m_file;
  std::string m_pointer;
  const KeyTable* m_keys = nullptr;
};

}  // namespace command
