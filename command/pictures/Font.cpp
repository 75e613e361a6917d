// SPDX-License-Identifier: Zlib
#include "command/pictures/Font.h"

#include "Embedded.h"

namespace pictures {

std::string_view fontFile() { return embedded::DejaVuSansSubset_ttf; }

}  // namespace pictures
