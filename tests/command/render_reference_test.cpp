#include "RenderCheck.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

// Pictures against those in tests/data/pictures. After a change of how things look: look at the new ones, and store
// them with WETCLOTH_STORE_PICTURES=1.

namespace {

using namespace command;

/// Mean difference of two drawings of one scene, in steps of 1/255. Another driver, compiler or precision moves edges
/// by part of a pixel, which in pictures of 160 x 120 comes to less than 1; the least of the mistakes below comes to 4.
constexpr double tolerance = 2;

struct Shot {
  std::string name;
  std::string scene;
  std::vector<std::string> options;
};

/// Early in each run, while another last digit has not yet become another fold.
const std::vector<Shot>& shots() {
  static const std::vector<Shot> all{
      {"towel_half_wet", "hanging_towel", {"--times", "2"}},
      {"towel_saturation", "hanging_towel", {"--times", "2", "--colouring", "saturation"}},
      {"cloth_on_sphere", "soak_and_drape_sphere", {"--times", "0.6"}},
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

}  // namespace

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

/// The tolerance tells a towel from one that is drawn dry, seen from elsewhere, or without its fabric.
TEST_F(RenderReference, MistakesAreLargerThanTheTolerance) {
  const Picture reference = readPicture(referenceOf("towel_half_wet"));
  Json dry = readJson(sceneFile("hanging_towel"));
  dry["cloths"][0]["effects"].erase("absorption");
  const std::string dryScene = m_directory.write("dry.json", dry.dump());
  EXPECT_GT(meanDifference(reference, draw(dryScene, {"--times", "2"})), tolerance);
  Json soaked = dry;
  soaked["cloths"][0]["initial_saturation"] = 1;
  const std::string soakedScene = m_directory.write("soaked.json", soaked.dump());
  EXPECT_GT(meanDifference(reference, draw(soakedScene, {"--times", "2"})), tolerance);
  EXPECT_GT(meanDifference(reference, draw(sceneFile("hanging_towel"), {"--times", "2", "--orbit", "5"})), tolerance);
  EXPECT_GT(meanDifference(reference, draw(sceneFile("hanging_towel"), {"--times", "2", "--colouring", "stretch"})),
            tolerance);
}
