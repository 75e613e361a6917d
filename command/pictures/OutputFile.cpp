// SPDX-License-Identifier: Zlib
#include "command/pictures/OutputFile.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace pictures {

OutputFile::OutputFile(const std::string& path) {
  errno = 0;
  m_stream.open(path, std::ios::binary | std::ios::trunc);
  if (!m_stream) fail();
}

void OutputFile::close() {
  m_stream.close();
  if (!m_stream) fail();
}

void OutputFile::fail() {
  const std::string why = errno == 0 ? "" : " (" + std::generic_category().message(errno) + ")";
  throw std::runtime_error("could not be written" + why);
}

void writeFile(const std::string& path, const std::string& bytes) {
  OutputFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
}

}  // namespace pictures
