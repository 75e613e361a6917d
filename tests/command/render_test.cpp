// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"
#include "tests/command/RenderCheck.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

// wetcloth render: what is made, and that nothing half-made is left.

namespace wetcloth_test::render_test {
namespace {

using namespace cli;

/// A sheet, seen from near.
Json sheetScene() {
  Json scene = smallScene();
  scene.erase("colliders");
  scene["camera"] = Json::parse(R"({"direction": [0.3, -1, -0.6]})");
  return scene;
}

class Render : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string missing = whyNothingCanBeDrawn();
    if (!missing.empty()) GTEST_SKIP() << missing;
  }
  std::string path(const std::string& name) const { return m_directory.path(name); }
  /// Renders the sheet, which must succeed; returns the results.
  Json render(const std::string& name, const std::vector<std::string>& more = {}) const {
    return renderScene(m_directory.write("scene.json", sheetScene().dump()), path(name), more);
  }

  TemporaryDirectory m_directory;
};

class RenderFilm : public Render {
 protected:
  void SetUp() override {
    Render::SetUp();
    if (runProgram({"ffprobe", "-version"}).status != 0) GTEST_SKIP() << "needs ffmpeg (Debian: apt install ffmpeg)";
  }
  Json probe(const std::string& file) const {
    const Outcome outcome =
        runProgram({"ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", file});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return Json::parse(outcome.out).at("streams").at(0);
  }
};

TEST_F(Render, PictureHasTheSizeAskedFor) {
  const Json result = render("a.png", {"--size", "161x97"});
  const Picture picture = readPicture(path("a.png"));
  EXPECT_EQ(picture.width, 161);
  EXPECT_EQ(picture.height, 97);
  EXPECT_EQ(result.at("width"), 161);
  EXPECT_EQ(result.at("height"), 97);
  EXPECT_EQ(result.at("frames"), 1);
  EXPECT_EQ(result.at("last_s"), 0.1);
  EXPECT_EQ(result.at("bytes"), std::filesystem::file_size(path("a.png")));
  EXPECT_GT(result.at("frames_drawn_per_second"), 0);
  EXPECT_NE(result.at("renderer"), "");
}

TEST_F(Render, SeveralTimesGiveAStrip) {
  render("strip.png", {"--size", "80x60", "--times", "0,0.05,0.1"});
  render("last.png", {"--size", "80x60", "--times", "0.1"});
  const Picture strip = readPicture(path("strip.png"));
  EXPECT_EQ(strip.width, 240);
  EXPECT_EQ(strip.height, 60);
}

TEST_F(Render, SameSceneGivesTheSamePicture) {
  render("a.png", {"--size", "80x60"});
  render("b.png", {"--size", "80x60"});
  EXPECT_EQ(meanDifference(readPicture(path("a.png")), readPicture(path("b.png"))), 0);
}

TEST_F(Render, CameraTurns) {
  render("a.png", {"--size", "80x60"});
  for (const std::vector<std::string>& camera : std::vector<std::vector<std::string>>{
           {"--orbit", "40"}, {"--view", "0,-1,-0.2"}, {"--field-of-view", "80"}, {"--colouring", "stretch"}}) {
    std::vector<std::string> more{"--size", "80x60"};
    more.insert(more.end(), camera.begin(), camera.end());
    render("b.png", more);
    EXPECT_GT(meanDifference(readPicture(path("a.png")), readPicture(path("b.png"))), 1) << camera[0];
  }
}

TEST_F(Render, CompareShowsPlainBulletDryAndWet) {
  Json scene = sheetScene();
  scene["cloths"][0]["initial_saturation"] = 1;
  const std::string file = m_directory.write("wet.json", scene.dump());
  renderScene(file, path("a.png"), {"--compare", "--size", "300x160", "--times", "0"});
  const Picture whole = readPicture(path("a.png"));
  const Picture plain = partOf(whole, 0, 40, 100, 80);
  const Picture dry = partOf(whole, 100, 40, 100, 80);
  const Picture wet = partOf(whole, 200, 40, 100, 80);
  EXPECT_LT(meanDifference(plain, dry), 0.5);
  EXPECT_GT(meanDifference(dry, wet), 1);
}

TEST_F(RenderFilm, FilmHasSizeRateAndLength) {
  for (const std::string name : {"a.mp4", "a.webm", "a.gif"}) {
    SCOPED_TRACE(name);
    render(name, {"--size", "96x64", "--fps", "20", "--duration", "0.5"});
    const Json stream = probe(path(name));
    EXPECT_EQ(stream.at("width"), 96);
    EXPECT_EQ(stream.at("height"), 64);
    EXPECT_EQ(stream.at("r_frame_rate"), "20/1");
    EXPECT_EQ(stream.at("nb_read_frames"), "11");
    EXPECT_TRUE(name == "a.gif" || stream.at("pix_fmt") == "yuv420p") << stream;
  }
}

TEST_F(RenderFilm, SlowMotionAndTimeLapse) {
  EXPECT_EQ(render("slow.mp4", {"--size", "96x64", "--speed", "0.25"}).at("frames"), 13);  // 0.1 s, 30 a second
  EXPECT_EQ(render("fast.mp4", {"--size", "96x64", "--speed", "2"}).at("frames"), 2);
}

TEST_F(RenderFilm, FilmStaysAsItWasWhenFfmpegDies) {
  const TemporaryDirectory programs;
  programs.write("ffmpeg",
                 "#!/bin/sh\ncase \"$1\" in -version) exit 0;; esac\nhead -c 20000 >/dev/null\n"
                 "echo 'first words' >&2\necho 'last words' >&2\nexit 3\n");
  std::filesystem::permissions(programs.path("ffmpeg"), std::filesystem::perms::owner_all);
  const ChangedVariable changed("PATH", programs.path("") + ":/usr/bin:/bin");
  m_directory.write("a.mp4", "what was there before");
  const std::string scene = m_directory.write("scene.json", sheetScene().dump());
  const Outcome outcome = runWetcloth({"render", scene, "--out", path("a.mp4"), "--duration", "1"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(outcome.err, "wetcloth: --out = \"" + path("a.mp4") + "\": ffmpeg failed: last words\n");
  EXPECT_EQ(namesIn(path("")), (std::vector<std::string>{"a.mp4", "scene.json"}));
  EXPECT_EQ(std::filesystem::file_size(path("a.mp4")), 21u);
}

TEST_F(Render, FilmWithoutFfmpegSaysWhatToInstall) {
  const ChangedVariable changed("PATH", "/nonexistent");
  const std::string scene = m_directory.write("scene.json", sheetScene().dump());
  const Outcome outcome = runWetcloth({"render", scene, "--out", path("a.gif")});
  expectRefusal(outcome, {"--out = \"" + path("a.gif") + "\"", "apt install ffmpeg"});
  EXPECT_EQ(namesIn(path("")), std::vector<std::string>{"scene.json"});
}

}  // namespace
}  // namespace wetcloth_test::render_test
