// SPDX-License-Identifier: Zlib
#include "command/cli/ShownField.h"

#include <cstddef>
#include <cstdio>

namespace command {

std::string shownField(std::string_view field) {
  constexpr std::size_t longest = 40;
  std::string text = "\"";
  for (const char character : field.substr(0, longest)) {
    const unsigned char byte = static_cast<unsigned char>(character);
    char hex[8];
    std::snprintf(hex, sizeof hex, "\\x%02x", static_cast<unsigned>(byte));
    text += byte >= 0x20 && byte < 0x7f ? std::string(1, character) : hex;
  }
  return text + (field.size() > longest ? "...\"" : "\"");
}

}  // namespace command
