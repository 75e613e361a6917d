// SPDX-License-Identifier: Zlib
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace command {

/// The words that an option or a key takes, each with what it stands for.
template <class Value>
using NamedValues = std::vector<std::pair<std::string, Value>>;

/// The value of a name that is known to be one of these.
template <class Value>
Value valueOf(const NamedValues<Value>& pairs, const std::string& wanted) {
  for (const auto& [name, value] : pairs) {
    if (name == wanted) return value;
  }
  throw std::logic_error("the name " + wanted + " was not checked");
}

/// The name of a value that is known to be one of these.
template <class Value>
std::string nameIn(const NamedValues<Value>& pairs, const Value& wanted) {
  for (const auto& [name, value] : pairs) {
    if (value == wanted) return name;
  }
  throw std::logic_error("a value without a name");
}

template <class Value>
std::vector<std::string> namesOf(const NamedValues<Value>& pairs) {
  std::vector<std::string> names;
  for (const auto& [name, value] : pairs) names.push_back(name);
  return names;
}

}  // namespace command
