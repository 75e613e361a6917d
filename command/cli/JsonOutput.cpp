// SPDX-License-Identifier: Zlib
#include "command/cli/JsonOutput.h"

#include "command/cli/Errors.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <system_error>
#include <utility>

namespace command {

JsonOutput::JsonOutput(std::string target) : m_target(std::move(target)) {
  if (!isFile()) return;
  std::error_code ignored;
  const bool isNew = !std::filesystem::exists(m_target, ignored);
  std::ofstream file(m_target, std::ios::app);
  if (!file) throw InputError("wetcloth: --json = \"" + m_target + "\": must be a file that can be written, or -");
  m_removeUnlessWritten = isNew;
}

JsonOutput::~JsonOutput() {
  std::error_code ignored;
  if (m_removeUnlessWritten) std::filesystem::remove(m_target, ignored);
}

void JsonOutput::write(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (ownsStandardOutput()) std::cout << text << std::flush;
  if (!isFile()) return;
  m_removeUnlessWritten = false;
  std::ofstream file(m_target, std::ios::trunc);
  file << text << std::flush;
  if (!file) throw RunError("wetcloth: --json = \"" + m_target + "\": could not be written");
}

}  // namespace command
