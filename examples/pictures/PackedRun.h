#pragma once

#include "Bounds.h"
#include "Recording.h"

#include <nlohmann/json.hpp>

#include <string>

namespace pictures {

/// A recording in few bytes, for page/unpack.js.
struct PackedRun {
  nlohmann::json head;  ///< counts and ranges that the bytes need to be understood
  std::string bytes;    ///< not yet compressed, but so that deflate makes little of them
};

/// Positions have 16 bits per axis, in a box around the run; saturation, stretch and speed have 8.
PackedRun packed(const Recording& recording);

}  // namespace pictures
