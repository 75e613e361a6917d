// SPDX-License-Identifier: Zlib
#include "command/scene/SkeletonMotion.h"

#include <stdexcept>

namespace command {

SkeletonMotion readSkeletonMotion(const std::string& file, const Placement&) {
  throw std::invalid_argument("\"" + file + "\" needs assimp, and this wetcloth was built without it " +
                              "(Debian: apt install libassimp-dev, then configure and build again)");
}

}  // namespace command
