// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/Bounds.h"
#include "command/pictures/FrameSequence.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pictures {

/// A sequence in few bytes, for page/unpack.js: not yet compressed, but so that deflate makes little of them.
/// Positions have 16 bits per axis, in a box around the run; saturation, stretch and speed have 8.
/// @param head  gets the counts and ranges that the bytes need to be understood
std::string packed(const FrameSequence& sequence, nlohmann::json& head);

}  // namespace pictures
