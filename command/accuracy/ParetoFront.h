// SPDX-License-Identifier: Zlib
#pragma once

#include "command/accuracy/Study.h"

#include <vector>

namespace accuracy {

/// Sets `isOnFront` of each point that no other one beats: none is as accurate and faster, or as fast and more
/// accurate. Points that are not compared, or whose error is not finite, are on no front.
void markFront(std::vector<Point>& points);

}  // namespace accuracy
