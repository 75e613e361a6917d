// SPDX-License-Identifier: Zlib
#include "command/cli/TextFile.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace command {
namespace {

constexpr std::size_t mostBytes = 256'000'000;  // some inputs never end

}  // namespace

std::string readTextFile(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw std::invalid_argument("no such file");
  if (std::filesystem::is_directory(status)) throw std::invalid_argument("is a directory, must be a file");
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  std::vector<char> part(1 << 16);
  while (stream.good()) {
    stream.read(part.data(), static_cast<std::streamsize>(part.size()));
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > mostBytes) throw std::invalid_argument("is longer than 256 MB, the most that is read");
  }
  if (!stream.eof()) throw std::invalid_argument("cannot be read");
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw std::invalid_argument("is empty");
  return text;
}

}  // namespace command
