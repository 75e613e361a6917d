// SPDX-License-Identifier: Zlib
#pragma once

#include <stdexcept>
#include <string>

namespace wetcloth_test {

/// The text of the std::invalid_argument that `action` throws, "" when it throws nothing.
template <class Action>
std::string rejection(Action action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace wetcloth_test
