// SPDX-License-Identifier: Zlib
#include "command/cli/NearestWord.h"

#include <algorithm>
#include <cstddef>

namespace command {

int editDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) cost[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) cost[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

namespace {

/// `step_ms` and `step_s` share a stem: a key with another unit is nearer than its letters say.
int keyDistance(const std::string& word, const std::string& known) {
  const std::string stem = known.substr(0, known.find('_'));
  const bool sharesStem = stem.size() >= 4 && word.compare(0, stem.size(), stem) == 0;
  return editDistance(word, known) - (sharesStem ? 2 : 0);
}

}  // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& known) {
  if (word.size() > 100) return "";  // no typo is that long, and the distance costs the product of the lengths
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
    return keyDistance(word, a) < keyDistance(word, b);
  });
  const int tolerated = std::max(2, static_cast<int>(word.size()) / 2);
  if (nearest == known.end() || keyDistance(word, *nearest) > tolerated) return "";
  return "did you mean \"" + *nearest + "\"? ";
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace command
