// SPDX-License-Identifier: Zlib
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

#if __has_include(<stb/stb_image.h>)
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#include <stb/stb_image.h>
#endif

namespace wetcloth_test::cli {
namespace {

void setVariable(const std::string& name, const std::optional<std::string>& value) {
#ifdef _WIN32
  _putenv_s(name.c_str(), value.value_or("").c_str());  // the empty one is taken away
#else
  if (value) {
    setenv(name.c_str(), value->c_str(), 1);
  } else {
    unsetenv(name.c_str());
  }
#endif
}

}  // namespace

std::string whyNothingCanBeDrawn() {
#ifndef STBI_ONLY_PNG
  return "needs stb_image.h to read pictures (Debian: apt install libstb-dev)";
#else
  static const std::string missing = [] {
    const TemporaryDirectory directory;
    const std::string scene = directory.write("scene.json", smallScene().dump());
    const Outcome outcome = runWetcloth({"render", scene, "--out", directory.path("a.png"), "--size", "16x16"});
    if (outcome.status == 0) return std::string();
    EXPECT_NE(outcome.err.find("apt install"), std::string::npos) << outcome.err;
    return outcome.err;
  }();
  return missing;
#endif
}

Json renderScene(const std::string& scene, const std::string& out, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"render", scene, "--out", out, "--json", "-", "--precision", testedPrecision()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = runWetcloth(arguments);
  if (outcome.status != 0) throw std::runtime_error(outcome.err);
  return Json::parse(outcome.out);
}

#ifdef STBI_ONLY_PNG
Picture readPicture(const std::string& file) {
  Picture picture;
  int channels = 0;
  std::uint8_t* const pixels = stbi_load(file.c_str(), &picture.width, &picture.height, &channels, 3);
  if (pixels == nullptr) throw std::runtime_error(file + ": " + stbi_failure_reason());
  const std::size_t count = 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  picture.rgb.assign(pixels, pixels + count);
  stbi_image_free(pixels);
  return picture;
}
#else
Picture readPicture(const std::string& file) { throw std::runtime_error(file + " cannot be read"); }
#endif

Picture partOf(const Picture& picture, int left, int top, int width, int height) {
  Picture part{width, height, {}};
  for (int y = top; y < top + height; ++y) {
    const auto* const row = picture.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * picture.width + left);
    part.rgb.insert(part.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(width));
  }
  return part;
}

double meanDifference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += std::abs(static_cast<int>(a.rgb[i]) - b.rgb[i]);
  return sum / static_cast<double>(a.rgb.size());
}

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

ChangedVariable::ChangedVariable(std::string name, const std::string& value) : m_name(std::move(name)) {
  if (const char* const before = std::getenv(m_name.c_str())) m_before = before;
  setVariable(m_name, value);
}

ChangedVariable::~ChangedVariable() { setVariable(m_name, m_before); }

}  // namespace wetcloth_test::cli

namespace wetcloth_test::render_check_test {

TEST(RenderCheck, DifferenceOfPicturesIsMeasured) {
  const cli::Picture grey{2, 1, {100, 100, 100, 100, 100, 100}};
  const cli::Picture other{2, 1, {100, 100, 100, 106, 94, 100}};
  EXPECT_EQ(meanDifference(grey, grey), 0);
  EXPECT_EQ(meanDifference(grey, other), 2);
  EXPECT_FALSE(std::isfinite(meanDifference(grey, partOf(grey, 1, 0, 1, 1))));
}

}  // namespace wetcloth_test::render_check_test
