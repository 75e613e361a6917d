// SPDX-License-Identifier: Zlib
#pragma once

#include "command/cli/StagedOutput.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>

namespace command {

/// Where --json goes: nowhere (""), standard output ("-") or a file. The file is tried before the work begins, so a
/// long run is not lost to a slip in its name, and has its name when it is whole.
class JsonOutput {
 public:
  /// Throws InputError when the file cannot be written.
  explicit JsonOutput(std::string target);

  /// Whether standard output belongs to the JSON, and nothing else may be printed there.
  bool ownsStandardOutput() const { return m_target == "-"; }
  /// Throws RunError when the file cannot be written.
  void write(const nlohmann::ordered_json& json);

 private:
  std::string m_target;
  std::optional<StagedOutput> m_file;  // none: a device or a pipe
};

}  // namespace command
