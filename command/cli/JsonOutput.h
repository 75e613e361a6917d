// SPDX-License-Identifier: Zlib
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace command {

/// Where --json goes: nowhere (""), standard output ("-") or a file. The file is tried before the work begins, so a
/// long run is not lost to a slip in its name.
class JsonOutput {
 public:
  /// Throws InputError when the file cannot be written.
  explicit JsonOutput(std::string target);
  ~JsonOutput();
  JsonOutput(const JsonOutput&) = delete;
  JsonOutput& operator=(const JsonOutput&) = delete;

  /// Whether standard output belongs to the JSON, and nothing else may be printed there.
  bool ownsStandardOutput() const { return m_target == "-"; }
  /// Throws RunError when the file cannot be written.
  void write(const nlohmann::ordered_json& json);

 private:
  bool isFile() const { return !m_target.empty() && m_target != "-"; }

  std::string m_target;
  bool m_removeUnlessWritten = false;
};

}  // namespace command
