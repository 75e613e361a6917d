// SPDX-License-Identifier: Zlib
#pragma once

#include <string>
#include <vector>

namespace accuracy {

struct AccuracyOptions {
  std::string study = "all";
  bool isQuick = false;
  std::string directory;  ///< of the plots and the page; empty: none
  std::string precision;  ///< empty: that of this program
  std::string json;
};

/// What `wetcloth accuracy --study` takes: the names of studyNames(), "precision" and "all".
std::vector<std::string> studyWords();

/// `wetcloth accuracy`. @param arguments of the program, for its sibling of the other precision
void studyAccuracy(const AccuracyOptions& options, char** arguments);

}  // namespace accuracy
