// SPDX-License-Identifier: Zlib
// The command goes on as the program beside it that computes in the other precision.

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace wetcloth_test::precision_program_test {
namespace {

using namespace cli;
namespace fs = std::filesystem;

/// A folder with the command, and beside it another program by the name of its sibling, or nothing.
class Siblings {
 public:
  explicit Siblings(const std::string& sibling) {
    const fs::path command = WETCLOTH_PROGRAM;
    fs::copy_file(command, m_folder.path(command.filename().string()));
    if (!sibling.empty()) fs::copy_file(sibling, m_folder.path("wetcloth-float64" + command.extension().string()));
  }
  Outcome run(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{m_folder.path(fs::path(WETCLOTH_PROGRAM).filename().string())};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return runProgram(words);
  }

 private:
  TemporaryDirectory m_folder;
};

class PrecisionProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(WETCLOTH_PROGRAM) != WETCLOTH_COMMAND) GTEST_SKIP() << "an emulated program starts no other";
    if (testedPrecision() != "float32") GTEST_SKIP() << "the command is of float64, and needs no sibling";
  }
};

TEST_F(PrecisionProgram, GetsTheSameWordsAndItsStatusIsTheCommands) {
  const TemporaryDirectory directory;
  const std::vector<std::string> words{"run",         directory.write("a scene.json", smallScene().dump()),
                                       "--precision", "float64",
                                       "--json",      directory.path("two  blanks")};
  const Outcome outcome = Siblings(WETCLOTH_SHOW_ARGUMENTS).run(words);
  EXPECT_EQ(outcome.status, 7) << outcome.err;
  std::istringstream lines(outcome.out);
  std::vector<std::string> got;
  for (std::string line; std::getline(lines, line);) got.push_back(line);
  EXPECT_EQ(got, words);
}

TEST_F(PrecisionProgram, ThatIsNotThereIsNamed) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  expectRefusal(Siblings("").run({"run", scene, "--precision", "float64"}), {"--precision", "wetcloth-float64"});
}

TEST_F(PrecisionProgram, OfTheSamePrecisionUnderBothNamesIsRefused) {
  const TemporaryDirectory directory;
  const std::string scene = directory.write("scene.json", smallScene().dump());
  expectRefusal(Siblings(WETCLOTH_PROGRAM).run({"run", scene, "--precision", "float64"}), {"--precision", "float32"});
}

}  // namespace
}  // namespace wetcloth_test::precision_program_test
