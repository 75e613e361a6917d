// SPDX-License-Identifier: Zlib
#pragma once

#include <fstream>
#include <string>

namespace pictures {

/// A file that is written from its start to its end, and tells when that did not work.
class OutputFile {
 public:
  /// Throws std::runtime_error that says why when the file cannot be opened.
  explicit OutputFile(const std::string& path);

  std::ostream& stream() { return m_stream; }
  /// Throws std::runtime_error that says why when not all of it could be written.
  void close();

 private:
  [[noreturn]] static void fail();

  std::ofstream m_stream;
};

/// Writes a whole file. Throws as the class does.
void writeFile(const std::string& path, const std::string& bytes);

}  // namespace pictures
