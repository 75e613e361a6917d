// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>

#ifndef _WIN32
#include <sys/wait.h>
#endif

namespace wetcloth_test::cli {
namespace {

#ifdef _WIN32

constexpr const char* kNothing = "NUL";

std::string quoted(const std::string& word) { return '"' + word + '"'; }

/// Its shell takes off one pair of quotes.
int statusOf(const std::string& line) { return std::system(quoted(line).c_str()); }

#else

constexpr const char* kNothing = "/dev/null";

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char character : word) text += character == '\'' ? std::string("'\\''") : std::string(1, character);
  return text + "'";
}

int statusOf(const std::string& line) {
  const int status = std::system(line.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

#endif

/// As a text: with the ends of lines that C++ has, not the system.
std::string contents(const std::string& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

Outcome runProgram(const std::vector<std::string>& words) {
  const TemporaryDirectory directory;
  std::string line;
  for (const std::string& word : words) line += quoted(word) + " ";
  line += ">" + quoted(directory.path("out")) + " 2>" + quoted(directory.path("err")) + " <" + kNothing;
  const int status = statusOf(line);
  return {status, contents(directory.path("out")), contents(directory.path("err"))};
}

Outcome runWetcloth(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{WETCLOTH_COMMAND};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return runProgram(words);
}

Json runCompared(const std::string& file, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run", file, "--json", "-", "--precision", testedPrecision()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Outcome outcome = runWetcloth(arguments);
  EXPECT_EQ(outcome.status, 0) << file << ": " << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

Json runScene(const std::string& file, const std::vector<std::string>& more) {
  std::vector<std::string> alone = more;
  alone.emplace_back("--no-comparison");
  return runCompared(file, alone);
}

Json runScene(const Json& scene, const std::vector<std::string>& more) {
  const TemporaryDirectory directory;
  return runScene(directory.write("scene.json", scene.dump()), more);
}

void expectRefusal(const Outcome& outcome, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.status, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& word : words) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
  }
}

std::string testedPrecision() {
#ifdef BT_USE_DOUBLE_PRECISION
  return "float64";
#else
  return "float32";
#endif
}

std::string sceneFile(const std::string& name) { return WETCLOTH_SOURCE_DIR "/examples/scenes/" + name + ".json"; }

std::vector<std::string> sceneFiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(WETCLOTH_SOURCE_DIR "/examples/scenes")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".json" && name != "scene.schema.json") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Json readJson(const std::string& file) { return Json::parse(contents(file)); }

Json smallScene() { return readJson(WETCLOTH_SOURCE_DIR "/tests/scenes/small.json"); }

TemporaryDirectory::TemporaryDirectory() {
  // Names are of one length: where memory lies may follow from it, and Bullet's trees from that.
  std::random_device random;
  std::uniform_int_distribution<std::uint64_t> sixteenDigits(1000000000000000, 9999999999999999);
  const auto name = std::filesystem::temp_directory_path() / ("wetcloth_test_" + std::to_string(sixteenDigits(random)));
  if (!std::filesystem::create_directory(name)) throw std::runtime_error("cannot make " + name.string());
  m_path = name.string();
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(m_path, ignored);
}

std::string TemporaryDirectory::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name);
}

}  // namespace wetcloth_test::cli

namespace wetcloth_test::command_test {

TEST(Command, VersionAndHelpEndWithStatusZero) {
  EXPECT_EQ(cli::runWetcloth({"--version"}).status, 0);
  EXPECT_EQ(cli::runWetcloth({"--version"}).out.rfind("wetcloth ", 0), 0u);
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"run", "--help"}, {"fall", "--help"}, {"validate", "--help"}}) {
    const cli::Outcome outcome = cli::runWetcloth(arguments);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("--help"), std::string::npos);
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_NE(cli::runWetcloth({"--help"}).out.find("Examples:"), std::string::npos);
}

}  // namespace wetcloth_test::command_test
