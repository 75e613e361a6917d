// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace stability {

struct StabilityOptions {
  std::string name;       ///< of a case; empty: all
  std::string group;      ///< empty: all
  std::string world;      ///< empty: all
  std::string step;       ///< "1/240" or "0.004" [s]; empty: all of the table
  std::string precision;  ///< empty: this program's
  bool isQuick = false;
  std::string json;
  std::string markdown;
};

/// `wetcloth stability`. @param arguments of the program, for its sibling of the other precision
void tryHardCases(const StabilityOptions& options, char** arguments);

}  // namespace stability
