// SPDX-License-Identifier: Zlib
#include "command/scene/ObjLines.h"

#include <algorithm>

namespace command {

ObjLines::ObjLines(const std::string& text) : m_text(text), m_place(text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0) {}

bool ObjLines::next() {
  m_line.clear();
  if (!takePhysicalLine()) return false;
  m_first = m_number;
  while (!m_line.empty() && m_line.back() == '\\') {
    m_line.back() = ' ';
    if (!takePhysicalLine()) break;
  }
  return true;
}

/// A comment goes no further than its line: one that ends with the name of a folder must not take a vertex along.
bool ObjLines::takePhysicalLine() {
  if (m_place >= m_text.size()) return false;
  const std::size_t end = std::min(m_text.find_first_of("\r\n", m_place), m_text.size());
  const auto begin = m_text.begin() + static_cast<std::ptrdiff_t>(m_place);
  m_line.append(begin, std::find(begin, m_text.begin() + static_cast<std::ptrdiff_t>(end), '#'));
  const bool isPair = m_text.compare(end, 2, "\r\n") == 0;
  m_place = end + (isPair ? 2 : 1);
  ++m_number;
  return true;
}

}  // namespace command
