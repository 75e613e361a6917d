// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <string>

namespace command {

struct CostOptions {
  std::string scene;         ///< empty: the built-in one
  std::string precision;     ///< empty: as the scene says
  std::optional<int> steps;  ///< of Bullet, measured in each world; none: as many as fit into some seconds
  std::string json;
};

/// `wetcloth cost`. @param arguments of the program, for its sibling of the other precision
void measureCost(const CostOptions& options, char** arguments);

}  // namespace command
