// SPDX-License-Identifier: Zlib
#include "command/cli/TextFile.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

namespace command {

std::string readTextFile(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw std::invalid_argument("no such file");
  if (std::filesystem::is_directory(status)) throw std::invalid_argument("is a directory, must be a file");
  std::ifstream stream(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream.good() && !stream.eof()) throw std::invalid_argument("cannot be read");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw std::invalid_argument("is empty");
  return text;
}

}  // namespace command
