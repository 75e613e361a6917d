// SPDX-License-Identifier: Zlib
#pragma once

#include "tests/command/Command.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wetcloth_test::cli {

/// Eight bits each of red, green and blue, from the top left, row by row.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Empty when `wetcloth render` can draw here, else what it says is missing. Anything but a missing package fails the
/// test instead.
std::string whyNothingCanBeDrawn();

/// Renders a scene file, which must succeed; returns the results.
Json renderScene(const std::string& scene, const std::string& out, const std::vector<std::string>& more);

/// Throws std::runtime_error when it is not a picture.
Picture readPicture(const std::string& file);
Picture partOf(const Picture& picture, int left, int top, int width, int height);
/// Of all channels of all pixels, in steps of 1/255. Infinite when the sizes differ.
double meanDifference(const Picture& a, const Picture& b);

/// What is in a folder, hidden files as well, sorted.
std::vector<std::string> namesIn(const std::string& folder);

/// A variable of the environment is another while it lives.
class ChangedVariable {
 public:
  ChangedVariable(std::string name, const std::string& value);
  ~ChangedVariable();
  ChangedVariable(const ChangedVariable&) = delete;
  ChangedVariable& operator=(const ChangedVariable&) = delete;

 private:
  std::string m_name;
  std::optional<std::string> m_before;
};

}  // namespace wetcloth_test::cli
