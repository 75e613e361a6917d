// SPDX-License-Identifier: Zlib
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

// Pictures against those in tests/data/pictures. After a change of how things look: look at the new ones, and store
// them with WETCLOTH_STORE_PICTURES=1.

namespace wetcloth_test::render_reference_test {
namespace {

using namespace cli;

/// Mean difference of two drawings of one scene, in steps of 1/255. Bullet in float64 instead of float32 comes to 0.1
/// in these pictures; another driver moves edges by part of a pixel, and each pixel on an edge is one of a few hundred
/// of 19200. Cloth whose wet parts are drawn as dry comes to 1.1 and 5.2 in the towels.
constexpr double tolerance = 0.75;

struct Shot {
  std::string name;
  std::string scene;
  std::vector<std::string> options;
};

/// Early in each run, while another last digit has not yet become another fold.
const std::vector<Shot>& shots() {
  static const std::vector<Shot> all{
      {"towel_half_wet", "hanging_towel", {"--times", "4"}},
      {"towel_saturation", "hanging_towel", {"--times", "2", "--colouring", "saturation"}},
      {"towel_wet", "laundry_line", {"--times", "0.3"}},
      {"cloth_on_sphere", "soak_and_drape_sphere", {"--times", "0.3"}},
      {"dipped", "dip_and_lift", {"--times", "3"}},
      {"flag_speed", "flag_wind_100", {"--times", "0.5", "--colouring", "speed"}}};
  return all;
}

std::string referenceOf(const std::string& name) { return WETCLOTH_SOURCE_DIR "/tests/data/pictures/" + name + ".png"; }

class RenderReference : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string missing = whyNothingCanBeDrawn();
    if (!missing.empty()) GTEST_SKIP() << missing;
  }
  Picture draw(const std::string& scene, std::vector<std::string> options) const {
    options.insert(options.end(), {"--size", "160x120"});
    renderScene(scene, m_directory.path("a.png"), options);
    return readPicture(m_directory.path("a.png"));
  }

  TemporaryDirectory m_directory;
};

TEST_F(RenderReference, PicturesAreThoseStored) {
  for (const Shot& shot : shots()) {
    SCOPED_TRACE(shot.name);
    const Picture picture = draw(sceneFile(shot.scene), shot.options);
    if (std::getenv("WETCLOTH_STORE_PICTURES") != nullptr) {
      std::filesystem::copy_file(m_directory.path("a.png"), referenceOf(shot.name),
                                 std::filesystem::copy_options::overwrite_existing);
    }
    EXPECT_LT(meanDifference(picture, readPicture(referenceOf(shot.name))), tolerance);
  }
}

/// The tolerance tells a towel from one that is dry, seen from elsewhere, or without its fabric.
TEST_F(RenderReference, MistakesAreLargerThanTheTolerance) {
  const Picture reference = readPicture(referenceOf("towel_wet"));
  Json dry = readJson(sceneFile("laundry_line"));
  dry["cloths"][0]["initial_saturation"] = 0;
  const std::string dryScene = m_directory.write("dry.json", dry.dump());
  EXPECT_GT(meanDifference(reference, draw(dryScene, {"--times", "0.3"})), 2 * tolerance);
  for (const std::vector<std::string>& mistake :
       std::vector<std::vector<std::string>>{{"--orbit", "5"}, {"--colouring", "stretch"}, {"--field-of-view", "60"}}) {
    SCOPED_TRACE(mistake[0]);
    const Picture picture = draw(sceneFile("laundry_line"), {"--times", "0.3", mistake[0], mistake[1]});
    EXPECT_GT(meanDifference(reference, picture), 2 * tolerance);
  }
}

}  // namespace
}  // namespace wetcloth_test::render_reference_test
