// SPDX-License-Identifier: Zlib
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace wetcloth_test::cli {

using Json = nlohmann::json;

/// What a program left behind.
struct Outcome {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a program to its end.
Outcome runProgram(const std::vector<std::string>& words);
/// Runs `wetcloth` with these arguments.
Outcome runWetcloth(const std::vector<std::string>& arguments);

/// Runs a scene file, which must succeed, in this test program's precision; returns its results. Plain Bullet is not
/// run beside it, which takes as long again.
Json runScene(const std::string& file, const std::vector<std::string>& more = {});
Json runScene(const Json& scene, const std::vector<std::string>& more = {});
/// The same beside plain Bullet.
Json runCompared(const std::string& file, const std::vector<std::string>& more = {});

/// One line on standard error with all these words in it, nothing on standard output, status 2.
void expectRefusal(const Outcome& outcome, const std::vector<std::string>& words);

/// The name of this test program's precision, for --precision.
std::string testedPrecision();

std::string sceneFile(const std::string& name);  ///< examples/scenes/NAME.json
std::vector<std::string> sceneFiles();           ///< all of examples/scenes
Json readJson(const std::string& file);
/// The scene of tests/scenes/small.json, to be changed.
Json smallScene();

/// A directory that is empty at first and gone with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

  std::string path(const std::string& name) const { return m_path + "/" + name; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string m_path;
};

}  // namespace wetcloth_test::cli
