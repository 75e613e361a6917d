// SPDX-License-Identifier: Zlib
#pragma once

#include <stdexcept>

namespace pictures {

/// Something that is installed apart from this program is not there. Its text says what and how to get it.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace pictures
