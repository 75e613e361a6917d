// SPDX-License-Identifier: Zlib
#include "command/cli/JsonOutput.h"

#include "command/cli/Errors.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>
#include <utility>

namespace command {
namespace {

std::string optionFor(const std::string& target) { return "wetcloth: --json = \"" + target + "\""; }

bool isDeviceOrPipe(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  return exists(status) && !is_regular_file(status) && !is_directory(status);
}

}  // namespace

JsonOutput::JsonOutput(std::string target) : m_target(std::move(target)) {
  if (m_target.empty() || ownsStandardOutput() || isDeviceOrPipe(m_target)) return;
  m_file.emplace(optionFor(m_target), m_target, StagedOutput::Kind::file);
}

void JsonOutput::write(const nlohmann::ordered_json& json) {
  if (m_target.empty()) return;
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (ownsStandardOutput()) {
    std::cout << text << std::flush;
    return;
  }
  std::ofstream file(m_file ? m_file->path() : m_target, std::ios::trunc);
  file << text << std::flush;
  if (!file) throw RunError(optionFor(m_target) + ": could not be written");
  file.close();
  if (m_file) m_file->commit();
}

}  // namespace command
