// SPDX-License-Identifier: Zlib
#pragma once

#include <stdexcept>
#include <string>

namespace command {

/// Bad usage or bad input: exit status 2. Its text is the one line that the user sees.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A run that could not be finished: exit status 1. Its text is the one line that the user sees.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text on one line: line breaks and tabs become spaces.
inline std::string onOneLine(std::string text) {
  for (char& character : text) {
    if (character == '\n' || character == '\r' || character == '\t') character = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace command
