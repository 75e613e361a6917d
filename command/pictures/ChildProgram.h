// SPDX-License-Identifier: Zlib
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pictures {

/// A program that runs beside this one and reads what is written to it.
class ChildProgram {
 public:
  /// Throws std::runtime_error when it cannot be started, and Unavailable when there is no such program; some systems
  /// know that at its end only, and then finish() throws it.
  /// @param words  its name, looked for in PATH, and its arguments
  explicit ChildProgram(const std::vector<std::string>& words);
  /// Ends it, if it has not ended.
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// False when it reads no more.
  bool write(const std::vector<std::uint8_t>& bytes);
  /// Tells it that there is no more, and waits for its end. Returns whether it succeeded. Throws Unavailable when there
  /// never was such a program.
  bool finish();
  /// The last line that it wrote to standard error; after finish().
  std::string complaint() const;

 private:
  std::string m_name;
  int m_input = -1;
  int m_errors = -1;
  int m_process = -1;
};

}  // namespace pictures
