// SPDX-License-Identifier: Zlib
#include "command/render/PictureSize.h"

#include "command/cli/Errors.h"

#include <cstdio>

namespace command {

PictureSize readSize(const std::string& text, bool evenOnly) {
  constexpr long least = 16;
  constexpr long most = 8192;
  long width = 0;
  long height = 0;
  char rest = 0;
  const bool isRead = std::sscanf(text.c_str(), "%5ldx%5ld%c", &width, &height, &rest) == 2;
  const auto isAllowed = [&](long pixels) {
    return pixels >= least && pixels <= most && (!evenOnly || pixels % 2 == 0);
  };
  if (isRead && isAllowed(width) && isAllowed(height)) return {static_cast<int>(width), static_cast<int>(height)};
  throw InputError("wetcloth: --size = \"" + onOneLine(text) + "\": must be WIDTHxHEIGHT, each " +
                   (evenOnly ? "even and " : "") + "from 16 to 8192 pixels");
}

}  // namespace command
