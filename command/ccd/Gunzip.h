// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace command {

/// The text of gzip data, or the data itself when it is not compressed. Throws std::invalid_argument when it is
/// damaged or cut short: what zlib's own reader lets pass, such as rubbish behind the end, could be the lost rest.
std::string gunzipped(std::string data);

}  // namespace command
