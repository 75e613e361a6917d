// SPDX-License-Identifier: Zlib
// What the command writes: nothing unfinished, nothing over what it reads, and nothing lost in silence. And the lines
// that it says when it cannot.
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#ifndef _WIN32
#include <sys/stat.h>
#endif

namespace wetcloth_test::command_files_test {
namespace {

using namespace cli;
namespace fs = std::filesystem;

class CommandFiles : public testing::Test {
 protected:
  CommandFiles() {
    Json json = smallScene();
    json["precision"] = testedPrecision();
    json["duration_s"] = 0.1;
    m_text = json.dump();
    m_scene = m_directory.write("scene.json", m_text);
  }

  std::string path(const std::string& name) const { return m_directory.path(name); }
  Outcome run(std::vector<std::string> more) const {
    std::vector<std::string> words = {"run", m_scene};
    words.insert(words.end(), more.begin(), more.end());
    return runWetcloth(words);
  }
  std::string scene() const {
    std::ifstream file(m_scene);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryDirectory m_directory;
  std::string m_text, m_scene;
};

TEST_F(CommandFiles, AreNotWrittenOverWhatIsReadOrOverEachOther) {
  expectRefusal(run({"--json", m_scene}), {"--json", m_scene, "another file than the scene"});
  expectRefusal(run({"--checkpoint", m_scene, "--every", "2"}), {"--checkpoint", "another file than the scene"});
  expectRefusal(run({"--json", path("a"), "--checkpoint", path("b/../a"), "--every", "2"}), {"--checkpoint", "--json"});
  expectRefusal(runWetcloth({"export", m_scene, "--format", "usda", "--out", path("z.usda"), "--json", path("z.usda")}),
                {"--out", "another file than --json"});
  expectRefusal(runWetcloth({"render", m_scene, "--out", path("z.html"), "--json", path("z.html")}),
                {"--out", "another file than --json"});
  expectRefusal(runWetcloth({"cost", m_scene, "--json", m_scene}), {"--json", "another file than the scene"});
  const std::string table = m_directory.write("m.csv", "time_s,water_kg_kg\n0,0\n1,1\n");
  expectRefusal(runWetcloth({"fit", table, "--of", "absorption", "--json", table}), {"--json", "the measurements"});
  expectRefusal(runWetcloth({"ccd", table, "--json", table}), {"--json", "the queries"});
  EXPECT_EQ(scene(), m_text);
}

#ifndef _WIN32
TEST_F(CommandFiles, GoWhereALinkLeads) {
  fs::create_symlink(m_scene, path("link.json"));
  expectRefusal(run({"--json", path("link.json")}), {"--json", "another file than the scene"});
  const std::string target = m_directory.write("target", "old");
  fs::create_symlink(target, path("link"));
  EXPECT_EQ(run({"--checkpoint", path("link"), "--every", "2"}).status, 0);
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_GT(fs::file_size(target), 100u);
}

TEST_F(CommandFiles, DoNotTakeTheNameOfAPipe) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expectRefusal(run({"--checkpoint", pipe, "--every", "2"}), {"--checkpoint", pipe, "a device or a pipe"});
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(CommandFiles, AFullDiskIsNoSuccess) {
  if (!fs::is_character_file("/dev/full")) GTEST_SKIP() << "without /dev/full";
  for (const std::string& more : std::vector<std::string>{"", " --json -"}) {
    const Outcome outcome =
        runProgram({"/bin/sh", "-c", "'" WETCLOTH_PROGRAM "' run '" + m_scene + "'" + more + " > /dev/full"});
    EXPECT_EQ(outcome.status, 1) << more;
    EXPECT_NE(outcome.err.find("standard output could not be written"), std::string::npos) << outcome.err;
  }
  const Outcome json = run({"--json", "/dev/full"});
  EXPECT_EQ(json.status, 1);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}
#endif

TEST_F(CommandFiles, JsonHasItsNameWhenItIsWhole) {
  const std::string before = m_directory.write("result.json", "before");
  Json blowsUp = Json::parse(m_text);
  blowsUp["cloths"][0]["effects"]["wind"] = {{"velocity_m_s", {0, 1e5, 1e5}}, {"integration", "explicit_euler"}};
  const std::string bad = m_directory.write("bad.json", blowsUp.dump());
  EXPECT_EQ(runWetcloth({"run", bad, "--json", before}).status, 1);
  std::ifstream file(before);
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "before");
  EXPECT_EQ(run({"--json", before}).status, 0);
  EXPECT_TRUE(readJson(before).contains("state_hash"));
  for (const fs::directory_entry& entry : fs::directory_iterator(m_directory.path("."))) {
    EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
  }
}

TEST_F(CommandFiles, EmptyWordsAreNotTakenForNone) {
  for (const char* const option : {"--json", "--checkpoint", "--resume", "--frames", "--duration", "--quality"}) {
    expectRefusal(run({option, ""}), {option, "is empty"});
    expectRefusal(run({std::string(option) + "="}), {option, "is empty"});
  }
  expectRefusal(runWetcloth({"run", ""}), {"after run", "is empty"});
  expectRefusal(runWetcloth({""}), {"is empty"});
  Json json = Json::parse(m_text);
  for (const std::string& name : std::vector<std::string>{"", std::string("o.obj\0x", 7)}) {
    json["colliders"] = {{{"mesh", name}}};
    expectRefusal(runWetcloth({"validate", m_directory.write("named.json", json.dump())}),
                  {"/colliders/0/mesh", "the name of a file"});
  }
}

TEST_F(CommandFiles, WhatIsSaidIsOneLineThatAScreenCanBear) {
  expectRefusal(runWetcloth({"fo\no"}), {"fo o"});
  expectRefusal(run({"--fo\no"}), {"--fo o"});
  expectRefusal(run({"--quality", "fi\nne"}), {"fi ne"});
  expectRefusal(run({"--json", path("a\nb/c")}), {"--json"});
  const Outcome coloured = runWetcloth({"run", path("\x1b[31mred")});
  expectRefusal(coloured, {"no such file"});
  EXPECT_EQ(coloured.err.find('\x1b'), std::string::npos);
  const std::string longKey(100000, 'k');
  const Outcome outcome =
      runWetcloth({"validate", m_directory.write("long.json", Json{{"world", "soft_rigid"}, {longKey, 1}}.dump())});
  expectRefusal(outcome, {"unknown key"});
  EXPECT_LT(outcome.err.size(), 10000u);
  std::string accents = "a";
  for (int k = 0; k < 100; ++k) accents += "\u00e9";
  const Outcome cut = runWetcloth({"validate", m_directory.write("utf.json", Json{{"world", accents}}.dump())});
  expectRefusal(cut, {"\u00e9..."});
}

TEST_F(CommandFiles, NestingAndNumbersOfAScene) {
  const std::string deep = std::string(300000, '[') + std::string(300000, ']');
  expectRefusal(runWetcloth({"validate", m_directory.write("deep.json", "{\"world\":" + deep + "}")}),
                {"deep.json", "nested deeper than 100"});
  const Outcome endless = runWetcloth({"validate", m_directory.write("endless.json", "{\"step_s\":1e999}")});
  expectRefusal(endless, {"endless.json", "not finite", "1e999"});
  EXPECT_EQ(endless.err.find("exception"), std::string::npos) << endless.err;
}

// Its square is more than float32 holds.
TEST_F(CommandFiles, AViewAlongAVectorOfAnyLength) {
  for (const char* const view : {"0,0,-1e20", "0,0,-1e300"}) {
    const std::string page = path("view.html");
    ASSERT_EQ(runWetcloth({"render", m_scene, "--out", page, "--view", view}).status, 0);
    std::ifstream file(page);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    const std::size_t at = text.find("\"viewDirection\":[");
    ASSERT_NE(at, std::string::npos);
    const std::string direction = text.substr(at, 40);
    EXPECT_EQ(direction.find("null"), std::string::npos) << direction;
    EXPECT_EQ(direction.find("[0,0,0]"), std::string::npos) << direction;
  }
}

}  // namespace
}  // namespace wetcloth_test::command_files_test
