// SPDX-License-Identifier: Zlib
#pragma once

#include "command/scene/Scene.h"

#include <optional>
#include <string>

namespace command {

struct FallOptions {
  std::optional<double> height;  ///< [m]; none: the mode's own
  std::string mode = "paper";
  std::string world = "soft_rigid";
  std::string precision;  ///< empty: this program's
  std::string json;
};

/// `wetcloth fall`. @param arguments of the program, for its sibling of the other precision
void compareFalls(const FallOptions& options, char** arguments);

}  // namespace command
