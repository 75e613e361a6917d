// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <string>

namespace command {

/// The lines of an OBJ file's text as they are meant: without comments and a UTF-8 mark, and in one piece where a `\`
/// at the end of a line goes on in the next. Lines end with LF, CR LF, or CR alone.
class ObjLines {
 public:
  /// @param text  must outlive this
  explicit ObjLines(const std::string& text);

  /// Goes to the next line; false when there is none.
  bool next();
  const std::string& text() const { return m_line; }
  /// Number in the file of the line in which it begins, from 1.
  int number() const { return m_first; }

 private:
  bool takePhysicalLine();

  const std::string& m_text;
  std::size_t m_place;
  std::string m_line;
  int m_number = 0;
  int m_first = 0;
};

}  // namespace command
