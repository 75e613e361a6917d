// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
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

/// The text without what follows these bytes, and without half a character (UTF-8) at its end.
inline std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  const auto continues = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80; };
  while (most > 0 && continues(most)) --most;
  return text.substr(0, most) + "...";
}

/// The text on one line that a screen can bear: what controls a terminal, line breaks and tabs too, becomes spaces, and
/// what is longer than anybody reads is left out.
inline std::string onOneLine(const std::string& whole) {
  constexpr std::size_t longest = 4000;
  std::string text = shortened(whole, longest);
  for (char& character : text) {
    const auto code = static_cast<unsigned char>(character);
    if (code < ' ' || code == 0x7F) character = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace command
