// SPDX-License-Identifier: Zlib
#pragma once

#include <optional>
#include <string>

namespace command {

struct CcdOptions {
  std::string file;
  std::string method = "conservative";
  std::optional<double> tolerance;  ///< none: the default
  int passes = 5;
  std::string precision;  ///< of Bullet; empty: this program's
  std::string json;
  bool disagreements = false;
};

/// `wetcloth ccd`. @param arguments of the program, for its sibling of the other precision
void checkQueries(const CcdOptions& options, char** arguments);

}  // namespace command
